#include "drivers/journal/journal_copy.h"

#include <unistd.h>

#include "drivers/journal/sqlite_database.h"
#include "drivers/journal/synced_file.h"

namespace tubesight::drivers {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> copy_journal(const std::string& from, const std::string& to, std::string& message) {
  if (::access(to.c_str(), F_OK) == 0) {
    message = to + ": is there already, expected a name that is free";
    return Unexpected(Error::kInvalidArgument);
  }
  const std::string part = to + ".part";
  ::unlink(part.c_str());
  ::unlink((part + "-wal").c_str());
  SqliteDatabase database;
  auto done = database.open(from, SqliteDatabase::Mode::kRead);
  if (done) {
    done = database.copy_to(part);
  }
  message = database.message();
  if (done) {
    done = move_synced(part, to, message);
  }
  if (!done) {
    ::unlink(part.c_str());
    ::unlink((part + "-wal").c_str());
    ::unlink((part + "-shm").c_str());
  }
  return done;
}

}  // namespace tubesight::drivers
