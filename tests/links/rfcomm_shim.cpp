// Replaces the kernel's RFCOMM on computers without a radio. Preloaded, it turns Bluetooth sockets
// into TCP sockets: connecting to the address ORB_SHIM_ROBOT (twelve digits, last byte first, as
// the kernel stores it) on channel 1 connects to the local port ORB_SHIM_PORT. As in the kernel,
// only one process can have the channel: the file ORB_SHIM_LOCK is locked meanwhile. The rest of
// the socket is the kernel's own.

#include <arpa/inet.h>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/socket.h>

namespace {

constexpr int rfcomm_protocol = 3;     // BTPROTO_RFCOMM
constexpr socklen_t address_size = 10; // of sockaddr_rc
constexpr unsigned char robot_channel = 1;

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// The errno of connecting to the address; 0 if the robot is there.
int refusal(const unsigned char* bytes) {
  char text[13];
  for (int i = 0; i < 6; ++i)
    std::snprintf(text + 2 * i, 3, "%02X", bytes[2 + i]);
  const char* robot = std::getenv("ORB_SHIM_ROBOT");
  if (robot == nullptr || std::strcmp(text, robot) != 0)
    return EHOSTDOWN;
  return bytes[8] == robot_channel ? 0 : ECONNREFUSED;
}

/// Takes the channel until this process ends; false if another process has it.
bool take_channel() {
  static const int file = ::open(std::getenv("ORB_SHIM_LOCK"), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  return ::flock(file, LOCK_EX | LOCK_NB) == 0;
}

} // namespace

extern "C" int socket(int family, int type, int protocol) noexcept {
  const auto real = next<int(int, int, int)>("socket");
  if (family == AF_BLUETOOTH && protocol == rfcomm_protocol)
    return real(AF_INET, type, 0);
  return real(family, type, protocol);
}

extern "C" int connect(int socket, const sockaddr* address, socklen_t size) {
  const auto real = next<int(int, const sockaddr*, socklen_t)>("connect");
  if (address->sa_family != AF_BLUETOOTH)
    return real(socket, address, size);
  if (size != address_size) {
    errno = EINVAL;
    return -1;
  }
  if (const int error = refusal(reinterpret_cast<const unsigned char*>(address)); error != 0) {
    errno = error;
    return -1;
  }
  if (!take_channel()) {
    errno = EBUSY;
    return -1;
  }
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<in_port_t>(std::atoi(std::getenv("ORB_SHIM_PORT"))));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return real(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place);
}
