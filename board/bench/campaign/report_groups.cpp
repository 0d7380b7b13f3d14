#include "board/bench/campaign/report_groups.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace tubesight::board::campaign {
namespace {

constexpr std::array<std::string_view, 5> kParts = {"pitch", "mounting", "weld", "fault", "speed"};

// The words of "square/upright/flush/none/slow".
std::array<std::string, kParts.size()> words_of(const std::string& name) {
  std::array<std::string, kParts.size()> words;
  std::size_t from = 0;
  for (std::string& word : words) {
    const std::size_t to = std::min(name.find('/', from), name.size());
    word = name.substr(from, to - from);
    from = to + 1;
  }
  return words;
}

void add(std::vector<ReportGroup>& groups, const std::string& name, const Counts& counts) {
  const auto known = std::find_if(groups.begin(), groups.end(),
                                  [&](const ReportGroup& group) { return group.name == name; });
  if (known != groups.end()) {
    known->counts += counts;
  } else {
    groups.push_back({name, counts});
  }
}

}  // namespace

std::vector<ReportGroup> report_groups(const Progress& progress, bool with_strata) {
  std::vector<ReportGroup> groups;
  const StrataCounts strata = progress.strata();
  add(groups, "all", progress.total());
  for (std::int32_t s = 0; s < kStrata; ++s) {
    const Counts& counts = strata[static_cast<std::size_t>(s)];
    const FaultGroup fault = stratum_at(s).fault;
    // A jump is no move that [motion] allows; a vibration shakes harder than [motion] allows.
    if (fault != FaultGroup::kJump) {
      add(groups, "within_motion", counts);
      add(groups, "within_motion steady", fault != FaultGroup::kMechanics ? counts : Counts{});
    }
  }
  for (std::size_t part = 0; part < kParts.size(); ++part) {
    for (std::int32_t s = 0; s < kStrata; ++s) {
      const Counts& counts = strata[static_cast<std::size_t>(s)];
      const auto words = words_of(name_of(stratum_at(s)));
      add(groups, std::string(kParts[part]) + "=" + words[part], counts);
      if (part == 0 && stratum_at(s).fault == FaultGroup::kNone) {
        add(groups, "clear", counts);
        add(groups, "clear " + words[2], counts);
      }
    }
  }
  if (with_strata) {
    for (std::int32_t s = 0; s < kStrata; ++s) {
      add(groups, name_of(stratum_at(s)), strata[static_cast<std::size_t>(s)]);
    }
  }
  return groups;
}

}  // namespace tubesight::board::campaign
