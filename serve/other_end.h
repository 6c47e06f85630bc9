#pragma once

namespace orb::serve {

/// Whether nobody is at the other end of a descriptor (any more); bytes may still wait.
bool other_end_left(int descriptor);

} // namespace orb::serve
