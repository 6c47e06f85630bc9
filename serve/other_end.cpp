#include "serve/other_end.h"

#include <poll.h>

namespace orb::serve {

bool other_end_left(int descriptor) {
  pollfd query{descriptor, POLLRDHUP, 0}; // POLLHUP is always reported
  return ::poll(&query, 1, 0) > 0;
}

} // namespace orb::serve
