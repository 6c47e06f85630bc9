#include "cli/terminal/keys.h"

#include "cli/context/console.h"

#include <conio.h>
#include <windows.h>

namespace orb::cli {

struct Keys::Before {
  DWORD mode = 0;
};

Keys::Keys() {
  DWORD mode = 0;
  const auto in = ::GetStdHandle(STD_INPUT_HANDLE);
  if (::GetConsoleMode(in, &mode) == 0)
    return;
  before_ = std::make_unique<Before>(Before{mode});
  ::SetConsoleMode(in, ENABLE_PROCESSED_INPUT); // Ctrl-C still interrupts
}

Keys::~Keys() {
  give_back();
}

void Keys::give_back() {
  if (before_ != nullptr)
    ::SetConsoleMode(::GetStdHandle(STD_INPUT_HANDLE), before_->mode);
}

bool Keys::from_terminal() const {
  return before_ != nullptr;
}

Pressed Keys::next(Wait wait) {
  if (!from_terminal()) {
    char byte = 0;
    if (wait == Wait::No && !input_waits())
      return {};
    return read_input({&byte, 1}) == 1 ? Pressed{Key::None, byte} : Pressed{Key::End, 0};
  }
  constexpr int first_of_two = 0xE0; // what an arrow begins with
  constexpr int up = 72;
  constexpr int left = 75;
  constexpr int right = 77;
  constexpr int down = 80;
  if (::_kbhit() == 0)
    return {};
  const int key = ::_getch();
  if (key != 0 && key != first_of_two)
    return {Key::None, static_cast<char>(key)};
  switch (::_getch()) {
  case up: return {Key::Up, 0};
  case down: return {Key::Down, 0};
  case left: return {Key::LeftArrow, 0};
  case right: return {Key::RightArrow, 0};
  default: return {};
  }
}

} // namespace orb::cli
