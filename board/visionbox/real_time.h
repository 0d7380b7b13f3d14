#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// What the tracking thread is to have; the table `[realtime]`.
struct RealTimeSettings {
  std::int32_t priority = 50;  ///< SCHED_FIFO, 1..99; 0: like every other thread
  bool lock_memory = true;     ///< nothing of the program may be swapped out
  double deadline_ms = 10.0;   ///< from a field's instant to its sighting; longer is counted
};

/// Locks all memory of the program, that to come as well. Empty when it is done, else why not.
[[nodiscard]] std::string lock_all_memory();

/// Gives the calling thread SCHED_FIFO with this priority. Empty when it is done, else why not.
[[nodiscard]] std::string schedule_in_real_time(std::int32_t priority);

/// Lets the calling thread run before all others of ordinary priority (nice -15), but not in real
/// time: whoever keeps it busy slows the others down and starves none. Empty when it is done, else
/// why not.
[[nodiscard]] std::string schedule_before_others();

/// Lets all threads of ordinary priority run before the calling one (nice 10), where the system
/// allows it: for what may take its time.
void schedule_behind_others();

/// Names the calling thread, for whoever looks at the process; 15 bytes at most.
void name_this_thread(const char* name);

/// Touches the stack that the calling thread will need, so that no page of it is missing later.
void touch_stack();

}  // namespace tubesight::board
