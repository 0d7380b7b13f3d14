#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "board/bench/campaign/counts.h"
#include "board/bench/campaign/stratum.h"

namespace tubesight::board::campaign {

/// The counts of each stratum.
using StrataCounts = std::array<Counts, static_cast<std::size_t>(kStrata)>;

/// What makes runs belong together.
struct CampaignIdentity {
  std::string box;            ///< version, and a digest of the program
  std::string configuration;  ///< what is drawn, and whether the margin check is on
  friend bool operator==(const CampaignIdentity&, const CampaignIdentity&) = default;
};

/// Consecutive moves of one seed, done.
struct DoneRange {
  std::uint64_t seed = 0;
  std::int64_t first = 0;    ///< move number
  std::int64_t end = 0;      ///< behind the last
  std::int64_t busy_ms = 0;  ///< time spent on them, summed over jobs
  StrataCounts strata{};
};

/// What a campaign has done so far; a progress file in memory.
class Progress {
 public:
  Progress() = default;
  explicit Progress(CampaignIdentity identity) : identity_(std::move(identity)) {}

  [[nodiscard]] const CampaignIdentity& identity() const { return identity_; }
  [[nodiscard]] const std::vector<DoneRange>& ranges() const { return ranges_; }

  /// The first move of `seed` at or after `move` that is not done.
  [[nodiscard]] std::int64_t next_move(std::uint64_t seed, std::int64_t move) const;

  /// Takes the counts of a move; it must not be done yet.
  void add(std::uint64_t seed, std::int64_t move, const Counts& counts, std::int64_t busy_ms);

  /// Takes over what another file did. False, with a line in `why`, when the files do not belong
  /// together or a move is in both.
  [[nodiscard]] bool absorb(const Progress& other, std::string& why);

  /// All ranges together.
  [[nodiscard]] StrataCounts strata() const;
  [[nodiscard]] Counts total() const;
  [[nodiscard]] std::int64_t busy_ms() const;

  /// The text of a progress file; docs/campaign.md has the columns.
  [[nodiscard]] std::string text() const;

  /// Reads the text of a file called `name`. False, with a line in `why`, when it is no whole
  /// progress file.
  [[nodiscard]] bool parse(const std::string& text, const std::string& name, std::string& why);

 private:
  void join_neighbours();

  CampaignIdentity identity_;
  std::vector<DoneRange> ranges_;  ///< by seed, then by move
};

}  // namespace tubesight::board::campaign
