#pragma once

namespace tubesight::board {

/// From now on Ctrl-C and the like (SIGINT, SIGTERM, SIGHUP) remove what is being written before
/// they end the program; one that was ignored when the program was started stays ignored.
///
/// The handler only tells a thread of its own, which removes, says so in one line and ends the
/// program by the same signal, so that a shell sees what it was. Where there can be no thread or
/// pipe, the signals end the program as they always do.
void remove_unfinished_when_interrupted();

}  // namespace tubesight::board
