#include "board/visionbox/page_access.h"

#include <array>

namespace tubesight::board {
namespace {

using drivers::PageAnswer;
using drivers::PageRequest;
using drivers::PageRole;

/// Who may ask for a path; a path that ends in `/` stands for all below it.
struct Rule {
  std::string_view method;
  std::string_view path;
  PageRole role;
  bool operates = false;  ///< and only whoever operates the box
};

constexpr std::array<Rule, 28> kRules = {{
    {"GET", "/api/session", PageRole::kNone},
    {"POST", "/api/login", PageRole::kNone},
    {"POST", "/api/logout", PageRole::kNone},
    {"GET", "/api/frame", PageRole::kViewer},
    {"GET", "/api/events", PageRole::kViewer},
    {"GET", "/api/status", PageRole::kViewer},
    {"GET", "/api/sheet", PageRole::kViewer},
    {"GET", "/api/visits", PageRole::kViewer},
    {"GET", "/api/frozen", PageRole::kViewer},
    {"GET", "/api/lattice", PageRole::kViewer},
    {"GET", "/api/disagreements", PageRole::kViewer},
    {"GET", "/api/disagreements/", PageRole::kViewer},
    {"POST", "/api/freeze", PageRole::kViewer},
    {"POST", "/api/pick", PageRole::kViewer},
    {"POST", "/api/self-test", PageRole::kViewer},
    {"GET", "/api/recordings", PageRole::kOperator},
    {"GET", "/api/recordings/", PageRole::kOperator},
    {"GET", "/api/settings", PageRole::kOperator},
    {"POST", "/api/operator", PageRole::kOperator},
    {"POST", "/api/record", PageRole::kOperator},
    {"POST", "/api/start", PageRole::kOperator, true},
    {"POST", "/api/lamp", PageRole::kOperator, true},
    {"POST", "/api/acknowledge", PageRole::kOperator, true},
    {"GET", "/api/backup", PageRole::kEngineer},
    {"POST", "/api/settings/check", PageRole::kEngineer},
    {"PUT", "/api/settings", PageRole::kEngineer},
    {"POST", "/api/window", PageRole::kEngineer, true},
    {"POST", "/api/optimum", PageRole::kEngineer, true},
}};

const Rule* rule_of(const PageRequest& request) {
  for (const Rule& rule : kRules) {
    const bool below = rule.path.ends_with('/');
    const bool same = below ? request.path.starts_with(rule.path) : request.path == rule.path;
    if (same && rule.method == request.method) {
      return &rule;
    }
  }
  return nullptr;
}

}  // namespace

PageAnswer json_answer(const Json& json, unsigned status) {
  PageAnswer answer;
  answer.status = status;
  answer.body = std::make_shared<const std::string>(text(json));
  return answer;
}

PageAnswer error_answer(unsigned status, std::string_view words) {
  return json_answer({{"error", words}}, status);
}

PageAccess::PageAccess(const PageSettings& settings, std::int32_t port)
    : settings_(&settings),
      names_(settings.server.address, port, !settings.server.certificate.empty(), settings.names) {}

PageRole PageAccess::role(const PageRequest& request, MonotonicTime now) {
  const drivers::PageSessions::Session* const session = sessions_.find(request.cookie, now);
  return session == nullptr ? PageRole::kNone : session->role;
}

std::optional<PageAnswer> PageAccess::refuse(const PageRequest& request, MonotonicTime now) {
  if (!names_.is_host(request.host)) {
    return error_answer(421, "the page is not served under that name (page.names)");
  }
  if (!request.origin.empty() && !names_.is_origin(request.origin)) {
    return error_answer(403, "asked by a page of another site");
  }
  if (!request.path.starts_with("/api/")) {
    return request.method == "GET" ? std::nullopt
                                   : std::optional(error_answer(405, "expected GET"));
  }
  const Rule* const rule = rule_of(request);
  if (rule == nullptr) {
    return error_answer(404, "there is no such thing here");
  }
  const PageRole has = role(request, now);
  if (has < rule->role) {
    return has == PageRole::kNone
               ? error_answer(401, "log in first")
               : error_answer(403, "for the role " + std::string(name_of(rule->role)) + " only");
  }
  if (request.method == "GET") {
    return {};
  }
  if (auto refusal = refuse_change(request, now)) {
    return refusal;
  }
  if (rule->operates && !sessions_.operates(request.cookie)) {
    const std::string& holder = sessions_.who_operates(now).name;
    const bool held = !sessions_.who_operates(now).session.empty();
    Json json = {{"error", held ? "somebody else operates the box" : "take the controls first"}};
    json["held_by"] = held ? Json(holder) : Json();
    return json_answer(json, 409);
  }
  return {};
}

std::optional<PageAnswer> PageAccess::refuse_change(const PageRequest& request, MonotonicTime now) {
  constexpr std::string_view kJson = "application/json";
  if (!std::string_view(request.type).starts_with(kJson)) {
    return error_answer(415, "expected application/json");
  }
  const drivers::PageSessions::Session* const session = sessions_.find(request.cookie, now);
  if (session == nullptr || session->token != request.token) {
    return error_answer(403, "without the token of its session: load the page again");
  }
  return {};
}

}  // namespace tubesight::board
