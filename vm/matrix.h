#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "spec/robots.h"
#include "vm/body/elsewhere.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace orb::vm {

/// Whether the robot has a matrix of lamps: it knows the command that sets one of them.
constexpr bool has_matrix(spec::Robot robot) {
  return spec::knows(spec::info(robot), spec::info(spec::V2Command::MatrixPixel));
}

/// The matrix of 8 × 8 lamps of a BOLT: what it shows, and what it plays by itself. It is told the
/// time and keeps none.
///
/// x counts to the right, y upwards, so (0,0) is the lamp at the bottom left. Source: a client
/// (spherov2.py, register_matrix_animation) hands over the rows of a frame from its lowest to its
/// highest, and the first column in the highest bit. What a client can draw outside is drawn
/// nowhere: a coordinate below 0 or above 7 lets the whole command do nothing.
///
/// What no document says: that drawing ends what plays, that an animation that has come to its end
/// leaves its last frame, how it fades, and which way the picture turns [?].
class Matrix {
public:
  static constexpr int side = 8;
  /// Row by row from the bottom, each from the left.
  using Pixels = std::array<Color, std::size_t{side} * side>;

  // Drawing.
  void fill(Color color);
  void pixel(int x, int y, Color color);
  /// From one lamp to the other, both included.
  void line(int x1, int y1, int x2, int y2, Color color);
  /// All lamps between two corners, in any order.
  void rectangle(int x1, int y1, int x2, int y2, Color color);
  /// One character on a dark matrix; `?` for what is not printable ASCII.
  void character(Color color, char character);
  /// Dark, and nothing plays.
  void clear();
  /// The picture shows turned by so many quarters clockwise, from now on. [?]
  void rotate(int quarters);

  // Playing.
  /// A text comes in from the right, a column a step, and leaves to the left; then the matrix is
  /// dark, or it comes in again. Steps a second, 0 to 30; with 0 its first column stands.
  void scroll(Color color, int frames_per_second, bool repeat, const std::string& text,
              Instant now);
  /// 32 bytes, else it does nothing: for each bit of the pixels' palette index, the lowest first, 8
  /// rows from the bottom, their left lamp in the highest bit.
  void save_frame(int index, ByteView bytes);
  /// Frames a second, 0 to 30; with 0 the first frame stands. An index without a colour in the
  /// palette is dark, and so is a frame that is not there.
  void save_animation(int id, int frames_per_second, bool fade, std::vector<Color> palette,
                      std::vector<int> frames);
  /// False where there is none of that id.
  bool play(int id, bool loop, Instant now);
  /// One frame, in the colours of the animation that was saved or played last, else in greys. [?]
  /// False where there is none of that index.
  bool show_frame(int index);
  /// What plays stands until resume().
  void pause(Instant now);
  void resume(Instant now);
  /// Deletes animations and frames; what they show stays, and plays no more.
  void forget();
  /// The indexes of the frames that are kept, ascending.
  std::vector<int> frames() const;
  /// Whether it changes by itself, now or once it is resumed.
  bool plays() const { return film_.has_value(); }

  // Time.
  /// Shows what is due.
  void advance(Instant now);
  /// When it changes next by itself; `never` while nothing moves.
  Instant next_event() const;

  /// As it shows, turned.
  const Pixels& pixels() const { return shown_; }

private:
  using Frame = std::array<std::uint8_t, std::size_t{side} * side>; ///< indexes into a palette
  struct Text {
    Color color;
    std::vector<std::uint8_t> columns; ///< the lowest lamp in the lowest bit
  };
  struct Animation {
    int frames_per_second = 0;
    bool fade = false;
    std::vector<Color> palette;
    std::vector<int> frames;
  };
  /// What plays: pictures, one after the other.
  struct Film {
    std::variant<Text, Animation> what;
    std::int64_t pictures = 0;
    bool loops = false;
    Duration step{}; ///< from one picture to the next; 0: the first stands
    Instant began{};
    std::int64_t at = 0; ///< the picture that shows, counted from the start
    bool paused = false;
    Duration played{}; ///< when it was paused
  };

  void show(const Pixels& picture);
  void begin(Film film);
  Pixels picture_of(const Text& text, std::int64_t step) const;
  Pixels picture_of(const Animation& animation, std::int64_t step) const;
  Pixels picture_of(int frame, const std::vector<Color>& palette) const;

  Pixels picture_{}; ///< as it was drawn
  Pixels shown_{};
  int quarters_ = 0;
  std::map<int, Frame> frames_;
  std::map<int, Animation> animations_;
  std::vector<Color> palette_; ///< of show_frame()
  std::optional<Film> film_;
};

/// `RRGGBB` of every lamp, in the order of the pixels.
std::string hex_of(const Matrix::Pixels& pixels);
/// The picture with all lamps in one colour.
Matrix::Pixels filled(Color color);

} // namespace orb::vm
