#include "drivers/web/page_server.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <set>

#include <arpa/inet.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "drivers/web/page_exchange.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr unsigned kSilence_s = 15;
constexpr std::size_t kConnectionMemory = std::size_t{24} * 1024;  // request line and headers
constexpr int kNice = 10;

/// Sent with every answer: no other site may frame the page, feed it scripts, or be told of it.
constexpr std::array<std::pair<const char*, const char*>, 6> kHeaders = {{
    {"Content-Security-Policy",
     "default-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'; base-uri 'none'; "
     "form-action 'none'; object-src 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
}};

std::string text_of(const char* text) { return text == nullptr ? std::string() : text; }

PageAnswer plain_answer(unsigned status, std::string_view words) {
  PageAnswer answer;
  answer.status = status;
  answer.body = std::make_shared<const std::string>("{\"error\":\"" + std::string(words) + "\"}");
  return answer;
}

MHD_Result take_argument(void* into, MHD_ValueKind /*kind*/, const char* key, const char* value) {
  auto& query = *static_cast<std::map<std::string, std::string>*>(into);
  constexpr std::size_t kMostArguments = 8;
  if (query.size() < kMostArguments) {
    query.emplace(text_of(key), text_of(value));
  }
  return MHD_YES;
}

void forget_body(void* body) { delete static_cast<std::shared_ptr<const std::string>*>(body); }

/// Read only: libmicrohttpd asks for bytes that it may not change, and takes a pointer that may.
void* bytes_of(const std::string& body) { return const_cast<char*>(body.data()); }

MHD_Response* make_file(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    close(file);
    return nullptr;
  }
  return MHD_create_response_from_fd64(static_cast<std::uint64_t>(status.st_size), file);
}

MHD_Response* make_body(const PageAnswer& answer) {
  if (answer.file >= 0) {
    return make_file(answer.file);
  }
  const std::shared_ptr<const std::string>& body = answer.body;
  if (body == nullptr || body->empty()) {
    return MHD_create_response_from_buffer(0, nullptr, MHD_RESPMEM_PERSISTENT);
  }
  auto* const kept = new std::shared_ptr<const std::string>(body);
  return MHD_create_response_from_buffer_with_free_callback_cls(body->size(), bytes_of(*body),
                                                                forget_body, kept);
}

}  // namespace

/// The daemon and those who are being served.
class PageServer::Hub {
 public:
  explicit Hub(PageHandler& handler) : handler_(&handler) {}
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;
  ~Hub() { close(); }

  [[nodiscard]] bool open(const PageServerSettings& settings, std::string& message);
  void close();
  [[nodiscard]] bool is_open() const { return daemon_ != nullptr; }
  [[nodiscard]] std::int32_t port() const {
    const MHD_DaemonInfo* const info = MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_BIND_PORT);
    return info == nullptr ? 0 : info->port;
  }
  void run();

  /// Wakes everybody who waits, for the end.
  void dismiss() {
    const std::lock_guard lock(mutex_);
    dismissing_ = true;
    for (const std::weak_ptr<PageExchange>& each : exchanges_) {
      if (const auto exchange = each.lock()) {
        exchange->answer(plain_answer(MHD_HTTP_SERVICE_UNAVAILABLE, "the box stops"));
        exchange->end();
      }
    }
  }

 private:
  using Waiting = std::set<std::weak_ptr<PageExchange>, std::owner_less<>>;

  static MHD_Result take(void* hub, MHD_Connection* connection, const char* url, const char* method,
                         const char* version, const char* data, std::size_t* size, void** context);
  static void finish(void* hub, MHD_Connection* connection, void** context,
                     MHD_RequestTerminationCode why);

  void read_head(MHD_Connection* connection, const char* url, const char* method,
                 PageRequest& request);
  [[nodiscard]] std::optional<PageAnswer> refuse(MHD_Connection* connection,
                                                 const PageRequest& request);
  MHD_Result answer(MHD_Connection* connection, const std::shared_ptr<PageExchange>& exchange);
  MHD_Result send(MHD_Connection* connection, const PageAnswer& answer, MHD_Response* response);

  PageHandler* handler_;
  MHD_Daemon* daemon_ = nullptr;
  bool tls_ = false;
  std::mutex mutex_;
  bool dismissing_ = false;
  Waiting exchanges_;
};

bool PageServer::Hub::open(const PageServerSettings& settings, std::string& message) {
  sockaddr_in6 six{};
  sockaddr_in four{};
  const auto port = htons(static_cast<std::uint16_t>(settings.port));
  const sockaddr* address = nullptr;
  unsigned flags = MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG;
  if (inet_pton(AF_INET, settings.address.c_str(), &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = port;
    address = reinterpret_cast<const sockaddr*>(&four);
  } else if (inet_pton(AF_INET6, settings.address.c_str(), &six.sin6_addr) == 1) {
    six.sin6_family = AF_INET6;
    six.sin6_port = port;
    address = reinterpret_cast<const sockaddr*>(&six);
    flags |= MHD_USE_IPv6;
  } else {
    message = "page: '" + settings.address + "' is no address";
    return false;
  }
  tls_ = !settings.certificate.empty();
  std::vector<MHD_OptionItem> options;
  if (tls_) {
    flags |= MHD_USE_TLS;
    options.push_back({MHD_OPTION_HTTPS_MEM_CERT, 0, bytes_of(settings.certificate)});
    options.push_back({MHD_OPTION_HTTPS_MEM_KEY, 0, bytes_of(settings.key)});
  }
  options.push_back({MHD_OPTION_END, 0, nullptr});
  const auto be_silent = [](void* /*nobody*/, const char* /*format*/, va_list /*values*/) {};
  daemon_ = MHD_start_daemon(
      flags, 0, nullptr, nullptr, &Hub::take, this, MHD_OPTION_EXTERNAL_LOGGER,
      static_cast<MHD_LogCallback>(be_silent), nullptr, MHD_OPTION_SOCK_ADDR, address,
      MHD_OPTION_NOTIFY_COMPLETED, &Hub::finish, this, MHD_OPTION_CONNECTION_LIMIT,
      kMostConnections + 16U, MHD_OPTION_PER_IP_CONNECTION_LIMIT, kMostPerAddress + 8U,
      MHD_OPTION_CONNECTION_TIMEOUT, kSilence_s, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
      kConnectionMemory, MHD_OPTION_LISTENING_ADDRESS_REUSE, 1U, MHD_OPTION_ARRAY, options.data(),
      MHD_OPTION_END);
  if (daemon_ == nullptr) {
    message = "page: cannot be served at " + settings.address + " port " +
              std::to_string(settings.port) + ": " +
              (errno != 0 ? std::strerror(errno) : "the certificate and its key are not usable");
    return false;
  }
  return true;
}

/// A connection that another thread resumes does not end the wait of libmicrohttpd 0.9.75, when the
/// loop is ours: while somebody waits for an answer, the waits are short.
void PageServer::Hub::run() {
  constexpr std::int32_t kIdle_ms = 200;
  constexpr std::int32_t kServing_ms = 4;  // beside 16.7 ms from a field to the next
  bool serving = false;
  {
    const std::lock_guard lock(mutex_);
    serving = !exchanges_.empty();
  }
  MHD_run_wait(daemon_, serving ? kServing_ms : kIdle_ms);
}

void PageServer::Hub::close() {
  if (daemon_ != nullptr) {
    MHD_stop_daemon(daemon_);
    daemon_ = nullptr;
  }
}

void PageServer::Hub::read_head(MHD_Connection* connection, const char* url, const char* method,
                                PageRequest& request) {
  const auto header = [connection](const char* name) {
    return text_of(MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name));
  };
  request.method = text_of(method);
  request.path = text_of(url);
  request.address = address_of(connection);
  request.host = header(MHD_HTTP_HEADER_HOST);
  request.origin = header("Origin");
  request.type = header(MHD_HTTP_HEADER_CONTENT_TYPE);
  request.token = header("X-Tubesight");
  request.cookie = text_of(MHD_lookup_connection_value(connection, MHD_COOKIE_KIND, kCookieName));
  MHD_get_connection_values(connection, MHD_GET_ARGUMENT_KIND, take_argument, &request.query);
}

std::optional<PageAnswer> PageServer::Hub::refuse(MHD_Connection* connection,
                                                  const PageRequest& request) {
  const MHD_DaemonInfo* const now =
      MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_CURRENT_CONNECTIONS);
  if (now != nullptr && now->num_connections > kMostConnections) {
    PageAnswer busy = plain_answer(MHD_HTTP_SERVICE_UNAVAILABLE, "the box serves too many already");
    busy.headers.emplace_back(MHD_HTTP_HEADER_RETRY_AFTER, "5");
    return busy;
  }
  if (request.method != "GET" && request.method != "POST" && request.method != "PUT") {
    return plain_answer(MHD_HTTP_METHOD_NOT_ALLOWED, "expected GET, POST or PUT");
  }
  if (request.path.size() > kLongestPath) {
    return plain_answer(MHD_HTTP_URI_TOO_LONG, "the path is too long");
  }
  if (!has_one_length(connection)) {
    return plain_answer(MHD_HTTP_BAD_REQUEST, "expected one length of the body");
  }
  const std::string length =
      text_of(MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Content-Length"));
  const std::uint64_t announced = std::strtoull(length.c_str(), nullptr, 10);
  if (request.method == "GET" && announced > 0) {
    return plain_answer(MHD_HTTP_BAD_REQUEST, "a GET has no body");
  }
  if (announced > handler_->most_body_bytes(request)) {
    return plain_answer(MHD_HTTP_CONTENT_TOO_LARGE, "the body is too long");
  }
  return handler_->refuse(request, announced);
}

MHD_Result PageServer::Hub::take(void* hub, MHD_Connection* connection, const char* url,
                                 const char* method, const char* /*version*/, const char* data,
                                 std::size_t* size, void** context) {
  auto& self = *static_cast<Hub*>(hub);
  if (*context == nullptr) {
    auto* const made =
        new std::shared_ptr<PageExchange>(std::make_shared<PageExchange>(connection));
    (*made)->know_itself(*made);
    *context = made;
    const std::lock_guard lock(self.mutex_);
    self.exchanges_.insert(*made);
  }
  const std::shared_ptr<PageExchange> exchange =
      *static_cast<std::shared_ptr<PageExchange>*>(*context);
  PageRequest& request = exchange->request;
  if (!exchange->begun) {
    exchange->begun = true;
    self.read_head(connection, url, method, request);
    if (const auto refusal = self.refuse(connection, request)) {
      return self.send(connection, *refusal, make_body(*refusal));
    }
    return MHD_YES;
  }
  if (*size > 0) {
    // Announced or not, no body grows beyond its bound; what comes after it is not kept.
    exchange->too_long =
        exchange->too_long || request.body.size() + *size > self.handler_->most_body_bytes(request);
    if (exchange->too_long) {
      return MHD_NO;
    }
    request.body.append(data, *size);
    *size = 0;
    return MHD_YES;
  }
  if (!exchange->handed_over) {
    exchange->handed_over = true;
    if (auto answer = self.handler_->handle(request, exchange)) {
      exchange->answer(std::move(*answer));
    }
    const std::lock_guard lock(self.mutex_);
    if (self.dismissing_) {
      exchange->answer(plain_answer(MHD_HTTP_SERVICE_UNAVAILABLE, "the box stops"));
    }
  }
  return self.answer(connection, exchange);
}

MHD_Result PageServer::Hub::answer(MHD_Connection* connection,
                                   const std::shared_ptr<PageExchange>& exchange) {
  if (exchange->wait()) {
    return MHD_YES;
  }
  if (exchange->streaming()) {
    PageAnswer head;
    head.type = "text/event-stream";
    return send(connection, head, make_stream(exchange));
  }
  const std::optional<PageAnswer> answer = exchange->taken();
  return send(connection, *answer, make_body(*answer));
}

MHD_Result PageServer::Hub::send(MHD_Connection* connection, const PageAnswer& answer,
                                 MHD_Response* response) {
  if (response == nullptr) {
    return MHD_NO;
  }
  for (const auto& [name, value] : kHeaders) {
    MHD_add_response_header(response, name, value);
  }
  MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, answer.type.c_str());
  bool cached = false;
  for (const auto& [name, value] : answer.headers) {
    cached = cached || name == MHD_HTTP_HEADER_CACHE_CONTROL;
    MHD_add_response_header(response, name.c_str(), value.c_str());
  }
  if (!cached) {
    MHD_add_response_header(response, MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
  }
  if (!answer.cookie.empty() || answer.forget_cookie) {
    const std::string cookie = std::string(kCookieName) + "=" + answer.cookie +
                               "; Path=/; HttpOnly; SameSite=Strict" + (tls_ ? "; Secure" : "") +
                               (answer.forget_cookie ? "; Max-Age=0" : "");
    MHD_add_response_header(response, MHD_HTTP_HEADER_SET_COOKIE, cookie.c_str());
  }
  const MHD_Result queued = MHD_queue_response(connection, answer.status, response);
  MHD_destroy_response(response);
  return queued;
}

void PageServer::Hub::finish(void* hub, MHD_Connection* /*connection*/, void** context,
                             MHD_RequestTerminationCode /*why*/) {
  auto* const exchange = static_cast<std::shared_ptr<PageExchange>*>(*context);
  if (exchange == nullptr) {
    return;
  }
  (*exchange)->forget_connection();
  auto& self = *static_cast<Hub*>(hub);
  {
    const std::lock_guard lock(self.mutex_);
    self.exchanges_.erase(*exchange);
  }
  delete exchange;
  *context = nullptr;
}

PageServer::PageServer(PageHandler& handler) : hub_(std::make_unique<Hub>(handler)) {}

PageServer::~PageServer() { stop(); }

Result<void> PageServer::start(const PageServerSettings& settings) {
  if (hub_->is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (!hub_->open(settings, message_)) {
    return Unexpected(Error::kIo);
  }
  port_ = hub_->port();
  stopping_ = false;
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "page");
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice);
    while (!stopping_) {
      hub_->run();
    }
  });
  return {};
}

void PageServer::stop() {
  if (!hub_->is_open()) {
    return;
  }
  stopping_ = true;
  hub_->dismiss();
  if (thread_.joinable()) {
    thread_.join();
  }
  hub_->dismiss();  // whoever came meanwhile
  hub_->close();
}

}  // namespace tubesight::drivers
