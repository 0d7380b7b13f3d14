#include "drivers/web/page_exchange.h"

#include <array>
#include <cstring>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <strings.h>
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

struct Lengths {
  int told = 0;
  bool plain = true;
};

MHD_Result note_length(void* into, MHD_ValueKind /*kind*/, const char* key, const char* value) {
  auto& lengths = *static_cast<Lengths*>(into);
  const std::string_view text = value == nullptr ? "" : value;
  if (strcasecmp(key, MHD_HTTP_HEADER_CONTENT_LENGTH) == 0) {
    ++lengths.told;
    lengths.plain = lengths.plain && !text.empty() &&
                    text.find_first_not_of("0123456789") == std::string_view::npos;
  } else if (strcasecmp(key, MHD_HTTP_HEADER_TRANSFER_ENCODING) == 0) {
    ++lengths.told;
    lengths.plain = lengths.plain && strcasecmp(value == nullptr ? "" : value, "chunked") == 0;
  }
  return MHD_YES;
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

bool has_one_length(MHD_Connection* connection) {
  Lengths lengths;
  MHD_get_connection_values(connection, MHD_HEADER_KIND, note_length, &lengths);
  return lengths.plain && lengths.told <= 1;
}

MHD_Response* make_stream(const std::shared_ptr<PageExchange>& exchange) {
  auto* const kept = new std::shared_ptr<PageExchange>(exchange);
  return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock, read_stream, kept,
                                           forget_stream);
}

}  // namespace tubesight::drivers
