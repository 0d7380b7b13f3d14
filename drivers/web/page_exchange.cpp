#include "drivers/web/page_exchange.h"

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

MHD_Response* make_stream(const std::shared_ptr<PageExchange>& exchange) {
  auto* const kept = new std::shared_ptr<PageExchange>(exchange);
  return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock, read_stream, kept,
                                           forget_stream);
}

}  // namespace tubesight::drivers
