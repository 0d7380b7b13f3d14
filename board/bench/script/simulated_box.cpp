#include "board/bench/script/simulated_box.h"

namespace tubesight::board {

core::Result<void> SimulatedBox::start() {
  TUBESIGHT_TRY(grabber_.start());
  TUBESIGHT_TRY(session_.configure(scenario_->told));
  return loop_.start();
}

}  // namespace tubesight::board
