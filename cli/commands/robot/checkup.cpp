#include "cli/commands/robot/checkup.h"

#include "uploader/device_words.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;
using uploader::Endpoint;
using uploader::Scheme;

constexpr int rfcomm_protocol = 3; // BTPROTO_RFCOMM
constexpr std::string_view rfkill_folder = "/sys/class/rfkill";
constexpr std::string_view adapters_folder = "/sys/class/bluetooth";

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// Checks if a radio switch blocks Bluetooth.
void check_rfkill(Checkup& checkup) {
  std::error_code error;
  for (fs::directory_iterator entry(rfkill_folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (first_line(entry->path() / "type") != "bluetooth")
      continue;
    if (first_line(entry->path() / "hard") == "1")
      checkup.bad("Bluetooth is switched off in hardware", "turn the radio switch on");
    else if (first_line(entry->path() / "soft") == "1")
      checkup.bad("Bluetooth is blocked", "`rfkill unblock bluetooth`");
    else
      checkup.good("no radio switch blocks Bluetooth");
  }
}

} // namespace

void check_bluetooth(Checkup& checkup) {
  const auto handle = ::socket(AF_BLUETOOTH, SOCK_STREAM, rfcomm_protocol);
  if (handle < 0) {
    checkup.bad(fmt::format("this system has no Bluetooth sockets: {}", std::strerror(errno)),
                "`sudo modprobe rfcomm`; in a container use tcp:// and a relay on the host: `socat "
                "FILE:/dev/rfcomm0,raw TCP-LISTEN:4242`");
    return;
  }
  ::close(handle);
  checkup.good("Bluetooth sockets are available");
  std::error_code error;
  if (fs::is_empty(adapters_folder, error) || error)
    checkup.bad("no Bluetooth adapter found", "plug one in; `bluetoothctl list` shows them");
  check_rfkill(checkup);
}

bool check_node(Checkup& checkup, const Endpoint& endpoint) {
  struct stat status {};
  if (::stat(endpoint.path.c_str(), &status) != 0) {
    checkup.bad(fmt::format("{}: {}", endpoint.path, std::strerror(errno)),
                endpoint.scheme == Scheme::Pty
                    ? "start a virtual ball: `orb ball --pty`"
                    : "`orb ports` lists what there is; `sudo rfcomm bind 0 AA:BB:CC:DD:EE:FF 1` "
                      "creates one for a paired ball");
    return false;
  }
  if (!S_ISCHR(status.st_mode)) {
    checkup.bad(fmt::format("{} is {}, not a device", endpoint.path,
                            S_ISDIR(status.st_mode) ? "a directory" : "a file"),
                "give the path of a device; `orb ports` lists them");
    return false;
  }
  checkup.good(fmt::format("{} is a device", endpoint.path));
  if (::access(endpoint.path.c_str(), R_OK | W_OK) != 0) {
    checkup.bad(fmt::format("no permission to read and write {}", endpoint.path),
                uploader::open_help(endpoint, EACCES));
    return false;
  }
  checkup.good("you have permission to read and write it");
  return true;
}

} // namespace orb::cli
