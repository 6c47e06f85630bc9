#include "cli/terminal/keys.h"
#include "cli/context/console.h"

#include <termios.h>
#include <unistd.h>

namespace orb::cli {
namespace {

/// The next byte; nothing at the end.
bool read_byte(char& byte) {
  return read_input({&byte, 1}) == 1;
}

/// What follows ESC: `[A` or `OA` for an arrow.
Key read_arrow() {
  char first = 0;
  char second = 0;
  if (!input_waits() || !read_byte(first) || (first != '[' && first != 'O') || !input_waits() ||
      !read_byte(second))
    return Key::None;
  return second == 'A'   ? Key::Up
         : second == 'B' ? Key::Down
         : second == 'C' ? Key::RightArrow
         : second == 'D' ? Key::LeftArrow
                         : Key::None;
}

} // namespace

struct Keys::Before {
  termios settings{};
};

Keys::Keys() {
  termios settings{};
  if (!is_terminal(Stream::In) || ::tcgetattr(STDIN_FILENO, &settings) != 0)
    return;
  before_ = std::make_unique<Before>(Before{settings});
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO); // keeps Ctrl-C
  ::tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

Keys::~Keys() {
  give_back();
}

void Keys::give_back() {
  if (before_ != nullptr)
    ::tcsetattr(STDIN_FILENO, TCSANOW, &before_->settings);
}

bool Keys::from_terminal() const {
  return before_ != nullptr;
}

Pressed Keys::next(Wait wait) {
  constexpr char escape = 0x1B;
  if ((from_terminal() || wait == Wait::No) && !input_waits())
    return {};
  char byte = 0;
  if (!read_byte(byte))
    return {Key::End, 0};
  if (byte == escape)
    return {read_arrow(), 0};
  return {Key::None, byte};
}

} // namespace orb::cli
