#pragma once

namespace orb::serve {

/// Returns true if the other end of a descriptor is closed; bytes may still be unread.
bool other_end_left(int descriptor);

} // namespace orb::serve
