#include "drivers/web/page_exchange.h"

#include <array>
#include <cstring>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace tubesight::drivers {
namespace {

constexpr std::size_t kStreamBlock = std::size_t{16} * 1024;

ssize_t read_stream(void* holder, std::uint64_t /*position*/, char* into, std::size_t room) {
  return (*static_cast<std::shared_ptr<PageExchange>*>(holder))->read(into, room);
}

void forget_stream(void* holder) {
  auto* const exchange = static_cast<std::shared_ptr<PageExchange>*>(holder);
  (*exchange)->end();
  delete exchange;
}

}  // namespace

std::string address_of(MHD_Connection* connection) {
  const MHD_ConnectionInfo* const info =
      MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (info == nullptr || info->client_addr == nullptr) {
    return {};
  }
  if (info->client_addr->sa_family == AF_INET) {
    sockaddr_in address{};
    std::memcpy(&address, info->client_addr, sizeof(address));
    inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  } else if (info->client_addr->sa_family == AF_INET6) {
    sockaddr_in6 address{};
    std::memcpy(&address, info->client_addr, sizeof(address));
    inet_ntop(AF_INET6, &address.sin6_addr, text.data(), text.size());
  }
  constexpr std::string_view kMapped = "::ffff:";
  const std::string whole = text.data();
  return whole.starts_with(kMapped) ? whole.substr(kMapped.size()) : whole;
}

MHD_Response* make_stream(const std::shared_ptr<PageExchange>& exchange) {
  auto* const kept = new std::shared_ptr<PageExchange>(exchange);
  return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock, read_stream, kept,
                                           forget_stream);
}

}  // namespace tubesight::drivers
