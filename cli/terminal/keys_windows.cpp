#include "cli/terminal/keys.h"

#include "cli/context/console.h"

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
  ::SetConsoleMode(in, ENABLE_PROCESSED_INPUT); // keeps Ctrl-C
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
  const auto in = ::GetStdHandle(STD_INPUT_HANDLE);
  INPUT_RECORD record{};
  DWORD count = 0;
  while (::PeekConsoleInputW(in, &record, 1, &count) != 0 && count == 1) {
    ::ReadConsoleInputW(in, &record, 1, &count);
    const auto& key = record.Event.KeyEvent;
    if (record.EventType != KEY_EVENT || key.bKeyDown == 0)
      continue;
    switch (key.wVirtualKeyCode) {
    case VK_UP: return {Key::Up, 0};
    case VK_DOWN: return {Key::Down, 0};
    case VK_LEFT: return {Key::LeftArrow, 0};
    case VK_RIGHT: return {Key::RightArrow, 0};
    default: break;
    }
    if (const auto letter = key.uChar.UnicodeChar; letter > 0 && letter < 0x80)
      return {Key::None, static_cast<char>(letter)};
  }
  return {};
}

} // namespace orb::cli
