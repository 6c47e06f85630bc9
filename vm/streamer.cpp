#include "vm/streamer.h"

namespace orb::vm {

void Streamer::run(Instant, Ball&) {}

} // namespace orb::vm
