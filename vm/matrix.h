#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "spec/robots.h"
#include "vm/body/remote_body.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace orb::vm {

/// Returns true if the robot has an LED matrix: it knows the command that sets one of its lamps.
constexpr bool has_matrix(spec::Robot robot) {
  return spec::knows(spec::info(robot), spec::info(spec::V2Command::MatrixPixel));
}

/// The matrix of 8 × 8 lamps of a BOLT: what it shows, and what it plays by itself. The caller
/// supplies the time.
///
/// x grows to the right, y upwards, so (0,0) is the lamp at the bottom left. Source: a client
/// (spherov2.py, register_matrix_animation) sends the rows of a frame from the lowest to the
/// highest, with the first column in the highest bit. A command with a coordinate outside 0 to 7
/// has no effect at all.
///
/// No document covers these: drawing ends what plays, a finished animation leaves its last frame,
/// how frames fade, and which way the picture turns [?]. Large because each command for the matrix
/// has its own member.
class Matrix {
public:
  static constexpr int side = 8;
  /// Rows from the bottom, each from the left.
  using Pixels = std::array<Color, std::size_t{side} * side>;

  // Drawing.
  void fill(Color color);
  void pixel(int x, int y, Color color);
  /// Draws a line, both ends included.
  void line(int x1, int y1, int x2, int y2, Color color);
  /// Fills a rectangle given by two corners in any order.
  void rectangle(int x1, int y1, int x2, int y2, Color color);
  /// Shows one character on a dark matrix; `?` if it is not printable ASCII.
  void character(Color color, char character);
  /// Turns all lamps off and stops what plays.
  void clear();
  /// Turns the picture by so many quarters clockwise, from now on. [?]
  void rotate(int quarters);

  // Playing.
  /// Scrolls a text from right to left, one column per step; then the matrix turns dark, or the
  /// text repeats. Steps a second, 0 to 30; with 0 the first column stays at the right edge.
  void scroll(Color color, int frames_per_second, bool repeat, const std::string& text,
              Instant now);
  /// Stores a frame of 32 bytes; other sizes have no effect. For each bit of the pixels' palette
  /// index, the lowest first, there are 8 rows from the bottom, the left lamp in the highest bit.
  void save_frame(int index, ByteView bytes);
  /// Stores an animation. Frames a second, 0 to 30; with 0 it stays at the first frame. Palette
  /// indexes without a colour and missing frames are dark.
  void save_animation(int id, int frames_per_second, bool fade, std::vector<Color> palette,
                      std::vector<int> frames);
  /// Returns false if there is no animation of that id.
  bool play(int id, bool loop, Instant now);
  /// Shows one frame in the palette of the animation saved or played last, otherwise in greys. [?]
  /// Returns false if there is no frame of that index.
  bool show_frame(int index);
  /// Freezes what plays until resume().
  void pause(Instant now);
  void resume(Instant now);
  /// Deletes animations and frames and stops what plays. The picture stays.
  void forget();
  /// The indexes of the stored frames, ascending.
  std::vector<int> frames() const;
  /// Returns true if it changes by itself, now or once resumed.
  bool plays() const { return film_.has_value(); }

  // Time.
  /// Shows the picture that is due.
  void advance(Instant now);
  /// When it next changes by itself; `never` if nothing moves.
  Instant next_event() const;

  /// The picture as it shows, rotated.
  const Pixels& pixels() const { return shown_; }

private:
  using Frame = std::array<std::uint8_t, std::size_t{side} * side>; ///< indexes into a palette
  struct Text {
    Color color;
    std::vector<std::uint8_t> columns; ///< bit 0 is the lowest lamp
  };
  struct Animation {
    int frames_per_second = 0;
    bool fade = false;
    std::vector<Color> palette;
    std::vector<int> frames;
  };
  /// A text or animation that plays, as a sequence of pictures.
  struct Film {
    std::variant<Text, Animation> what;
    std::int64_t pictures = 0;
    bool loops = false;
    Duration step{}; ///< time per picture; 0: stays at the first
    Instant began{};
    std::int64_t at = 0; ///< index of the picture that shows, counted from the start
    bool paused = false;
    Duration played{}; ///< time played before the pause
  };

  void show(const Pixels& picture);
  void begin(Film film);
  Pixels picture_of(const Text& text, std::int64_t step) const;
  Pixels picture_of(const Animation& animation, std::int64_t step) const;
  Pixels picture_of(int frame, const std::vector<Color>& palette) const;

  Pixels picture_{}; ///< before rotation
  Pixels shown_{};
  int quarters_ = 0;
  std::map<int, Frame> frames_;
  std::map<int, Animation> animations_;
  std::vector<Color> palette_; ///< used by show_frame()
  std::optional<Film> film_;
};

/// Returns `RRGGBB` of every lamp, in the order of the pixels.
std::string hex_of(const Matrix::Pixels& pixels);
/// Returns a picture with all lamps in one colour.
Matrix::Pixels filled(Color color);

} // namespace orb::vm
