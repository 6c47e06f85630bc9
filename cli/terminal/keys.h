#pragma once

#include <cstdint>
#include <memory>

namespace orb::cli {

/// Terminal keys that are not characters.
enum class Key : std::uint8_t { None, Up, Down, LeftArrow, RightArrow, End };

/// A key or a character; neither if nothing was pressed. `End`: the input has ended.
struct Pressed {
  Key key = Key::None;
  char character = 0;
};

/// Reads keys from standard input: from a terminal one by one without echo, until give_back(); from
/// a pipe its characters.
class Keys {
public:
  Keys();
  ~Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  bool from_terminal() const;
  /// Tells if next() waits for an empty pipe; it never waits for a terminal.
  enum class Wait : std::uint8_t { No, ForPipe };
  Pressed next(Wait wait);
  /// Restores the terminal.
  void give_back();

private:
  struct Before;
  std::unique_ptr<Before> before_; ///< for a terminal; else null
};

} // namespace orb::cli
