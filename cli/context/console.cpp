#include "cli/context/console.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace orb::cli {
namespace {

int descriptor(Stream stream) {
  switch (stream) {
  case Stream::In: return STDIN_FILENO;
  case Stream::Out: return STDOUT_FILENO;
  case Stream::Err: break;
  }
  return STDERR_FILENO;
}

/// Opens a closed stdin, stdout or stderr as a dummy. Otherwise the next file or socket would take
/// its number and receive what is printed. Using the stream is still an error.
void keep_standard_streams_apart() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(fd, F_GETFD) < 0)
      static_cast<void>(::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

} // namespace

std::vector<std::string> begin_process(int argc, char** argv) {
  keep_standard_streams_apart();
  // Makes writing to a closed pipe or socket, or beyond the file size limit, an error instead of a
  // fatal signal.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return {argv, argv + argc};
}

bool is_terminal(Stream stream) {
  return ::isatty(descriptor(stream)) == 1;
}

bool can_draw(Stream stream) {
  const char* term = std::getenv("TERM");
  return is_terminal(stream) && term != nullptr && std::string_view(term) != "dumb";
}

bool input_waits() {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  return ::poll(&in, 1, 0) > 0;
}

ssize_t read_input(std::span<char> bytes) {
  return ::read(STDIN_FILENO, bytes.data(), bytes.size());
}

bool write_to(Stream stream, std::string_view text) {
  auto* const file = stream == Stream::Out ? stdout : stderr;
  return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
}

std::pair<std::size_t, std::size_t> screen() {
  constexpr std::size_t usual_rows = 24;
  constexpr std::size_t usual_columns = 80;
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0 || size.ws_col == 0)
    return {usual_rows, usual_columns};
  return {size.ws_row, size.ws_col};
}

void end_if_unread(int error) {
  if (error != EPIPE)
    return;
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

std::optional<std::string> make_temporary_folder() {
  std::error_code problem;
  const auto folder = std::filesystem::temp_directory_path(problem);
  auto own = (folder / "orb-XXXXXX").string();
  if (problem || ::mkdtemp(own.data()) == nullptr)
    return std::nullopt;
  return own;
}

} // namespace orb::cli
