#include "board/bench/reconcile/journal_seal.h"

#include "drivers/journal/signing_key.h"

namespace tubesight::board {
namespace {

std::string signature_text(const SealedJournal& journal) {
  const drivers::JournalCheck& check = journal.check;
  if (check.key.empty()) {
    return "Nothing is signed: whoever changed a row and reckoned the chain anew is not found out.";
  }
  std::string text = "Signed up to row " + std::to_string(check.signed_through);
  const std::int64_t behind = check.last - check.signed_through;
  text += behind > 0 ? "; " + counted(behind, "row") + " behind it " +
                           (behind == 1 ? "is" : "are") + " not signed yet."
                     : ", the last one.";
  return text + (journal.key_known
                     ? " The key is the one given."
                     : " The key was not compared with one known: that it is the box's own is not "
                       "proved.");
}

}  // namespace

std::string counted(std::int64_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

std::optional<SealedJournal> check_seal(const std::string& path, const std::string& key_path,
                                        std::string& message, std::int64_t at_least) {
  SealedJournal journal;
  journal.path = path;
  drivers::JournalCheckOptions wanted;
  wanted.at_least = at_least;
  if (!key_path.empty()) {
    const auto key = drivers::read_public_key(key_path, message);
    if (!key) {
      return {};
    }
    wanted.key = *key;
    journal.key_known = true;
  }
  auto found = drivers::check_journal(path, wanted, message);
  if (!found) {
    return {};
  }
  journal.check = *found;
  return journal;
}

std::string seal_text(const SealedJournal& journal) {
  const drivers::JournalCheck& check = journal.check;
  if (check.rows == 0) {
    return "The journal holds no row.";
  }
  if (check.wrong > 0) {
    return "BROKEN: " + counted(check.wrong, "thing") + " of " + counted(check.rows, "row") + " " +
           (check.wrong == 1 ? "is" : "are") +
           " not what was written. This journal proves nothing. " + signature_text(journal);
  }
  return "The chain of " + counted(check.rows, "row") +
         " is whole: none was changed, taken out or moved. " + signature_text(journal);
}

}  // namespace tubesight::board
