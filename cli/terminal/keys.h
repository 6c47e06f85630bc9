#pragma once

#include <cstdint>
#include <memory>

namespace orb::cli {

/// Keys of a terminal that are no characters.
enum class Key : std::uint8_t { None, Up, Down, LeftArrow, RightArrow, End };

/// What was pressed: a key, or a character; neither where nothing was. `End`: no more will come.
struct Pressed {
  Key key = Key::None;
  char character = 0;
};

/// The keys of standard input. A terminal hands them over one by one, without showing them, until
/// give_back(); a pipe its characters.
class Keys {
public:
  Keys();
  ~Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  bool from_terminal() const;
  /// Whether next() waits for a pipe that has nothing yet; for a terminal it never does.
  enum class Wait : std::uint8_t { No, ForPipe };
  Pressed next(Wait wait);
  /// The terminal is as it was.
  void give_back();

private:
  struct Before;
  std::unique_ptr<Before> before_; ///< of a terminal; else null
};

} // namespace orb::cli
