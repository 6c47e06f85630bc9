#include "serve/other_end.h"

#include <winsock2.h>

namespace orb::serve {

bool other_end_left(int descriptor) {
  WSAPOLLFD query{static_cast<SOCKET>(descriptor), POLLRDNORM, 0};
  return ::WSAPoll(&query, 1, 0) > 0 && (query.revents & (POLLHUP | POLLERR)) != 0;
}

} // namespace orb::serve
