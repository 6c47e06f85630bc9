#include "vm/matrix.h"

#include "vm/matrix_font.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>

namespace orb::vm {
namespace {

constexpr int matrix_side = Matrix::side;
constexpr int fastest = 30; // frames a second
constexpr int word_gap = 3; // columns of a space

bool is_on_matrix(int at) {
  return at >= 0 && at < matrix_side;
}

std::size_t index_of(int x, int y) {
  return static_cast<std::size_t>(y * matrix_side + x);
}

Duration step_of(int frames_per_second) {
  return frames_per_second <= 0 ? Duration{} : Duration{1s} / std::min(frames_per_second, fastest);
}

/// Returns the columns of a character, from the left; bit 0 is the lowest lamp.
std::vector<std::uint8_t> columns_of(char character) {
  const char known = character < font::first || character > font::last ? '?' : character;
  const int place = known - font::first;
  const auto row = static_cast<std::size_t>(place / font::per_band * font::rows);
  const auto left = static_cast<std::size_t>(place % font::per_band * font::pitch);
  std::vector<std::uint8_t> columns;
  for (std::size_t x = 0; x + 1 < font::pitch; ++x) {
    unsigned bits = 0;
    for (std::size_t y = 0; y < font::rows; ++y)
      bits = bits << 1U | (font::art[row + y][left + x] == '#' ? 1U : 0U);
    columns.push_back(static_cast<std::uint8_t>(bits));
  }
  while (!columns.empty() && columns.back() == 0)
    columns.pop_back();
  if (columns.empty())
    columns.resize(word_gap);
  return columns;
}

/// A column of a picture.
void draw_column(Matrix::Pixels& picture, int x, std::uint8_t column, Color color) {
  for (int y = 0; is_on_matrix(x) && y < matrix_side; ++y)
    if ((column >> y & 1) != 0)
      picture[index_of(x, y)] = color;
}

/// Mixes two colours: `part` of `parts` of the way from the first to the second.
Color between(Color from, Color to, int part, int parts) {
  const auto mix = [&](int a, int b) {
    return static_cast<std::uint8_t>(a + (b - a) * part / parts);
  };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

/// The number of pictures into which a fading frame is divided: as many as its time holds at the
/// fastest rate. [?]
int pictures_in_frame(int frames_per_second, bool fade) {
  return fade && frames_per_second > 0 ? std::max(fastest / frames_per_second, 1) : 1;
}

} // namespace

// Drawing.

void Matrix::show(const Pixels& picture) {
  picture_ = picture;
  constexpr int far = side - 1;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      // The lamp of the unrotated picture that shows at (x,y).
      const std::size_t from = quarters_ == 0   ? index_of(x, y)
                               : quarters_ == 1 ? index_of(far - y, x)
                               : quarters_ == 2 ? index_of(far - x, far - y)
                                                : index_of(y, far - x);
      shown_[index_of(x, y)] = picture_[from];
    }
}

void Matrix::fill(Color color) {
  film_.reset();
  show(filled(color));
}

void Matrix::pixel(int x, int y, Color color) {
  rectangle(x, y, x, y, color);
}

void Matrix::line(int x1, int y1, int x2, int y2, Color color) {
  if (!is_on_matrix(x1) || !is_on_matrix(y1) || !is_on_matrix(x2) || !is_on_matrix(y2))
    return;
  film_.reset();
  auto picture = picture_;
  const int steps = std::max({std::abs(x2 - x1), std::abs(y2 - y1), 1});
  // Add half a step before the division, to round to the nearest lamp.
  const auto at = [&](int from, int to, int step) {
    return (2 * (from * steps + (to - from) * step) + steps) / (2 * steps);
  };
  for (int step = 0; step <= steps; ++step)
    picture[index_of(at(x1, x2, step), at(y1, y2, step))] = color;
  show(picture);
}

void Matrix::rectangle(int x1, int y1, int x2, int y2, Color color) {
  if (!is_on_matrix(x1) || !is_on_matrix(y1) || !is_on_matrix(x2) || !is_on_matrix(y2))
    return;
  film_.reset();
  auto picture = picture_;
  for (int y = std::min(y1, y2); y <= std::max(y1, y2); ++y)
    for (int x = std::min(x1, x2); x <= std::max(x1, x2); ++x)
      picture[index_of(x, y)] = color;
  show(picture);
}

void Matrix::character(Color color, char character) {
  film_.reset();
  const auto columns = columns_of(character);
  const int width = static_cast<int>(columns.size());
  Pixels picture{};
  for (int x = 0; x < width; ++x)
    draw_column(picture, (side - width) / 2 + x, columns[static_cast<std::size_t>(x)], color);
  show(picture);
}

void Matrix::clear() {
  fill({});
}

void Matrix::rotate(int quarters) {
  constexpr int whole = 4;
  quarters_ = (quarters % whole + whole) % whole;
  show(picture_);
}

// Playing.

Matrix::Pixels Matrix::picture_of(const Text& text, std::int64_t step) const {
  // In the first picture column 0 shows at the right edge, in the last one none does.
  Pixels picture{};
  const auto first = step - (side - 1);
  for (int x = 0; x < side; ++x)
    if (const auto column = first + x;
        column >= 0 && column < static_cast<std::int64_t>(text.columns.size()))
      draw_column(picture, x, text.columns[static_cast<std::size_t>(column)], text.color);
  return picture;
}

Matrix::Pixels Matrix::picture_of(int frame, const std::vector<Color>& palette) const {
  Pixels picture{};
  const auto found = frames_.find(frame);
  for (std::size_t i = 0; found != frames_.end() && i < picture.size(); ++i)
    if (const std::size_t color = found->second[i]; color < palette.size())
      picture[i] = palette[color];
  return picture;
}

Matrix::Pixels Matrix::picture_of(const Animation& animation, std::int64_t step) const {
  const int parts = pictures_in_frame(animation.frames_per_second, animation.fade);
  const auto frame = static_cast<std::size_t>(step / parts);
  const auto part = static_cast<int>(step % parts);
  auto picture = picture_of(animation.frames[frame], animation.palette);
  if (part == 0)
    return picture;
  const auto next =
      picture_of(animation.frames[(frame + 1) % animation.frames.size()], animation.palette);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = between(picture[i], next[i], part, parts);
  return picture;
}

/// Shows the first picture. A film of one picture does not play.
void Matrix::begin(Film film) {
  film_ = std::move(film);
  show(std::visit([&](const auto& what) { return picture_of(what, 0); }, film_->what));
  if (film_->step == Duration{} || film_->pictures < 2)
    film_.reset();
}

void Matrix::scroll(Color color, int frames_per_second, bool repeat, const std::string& text,
                    Instant now) {
  std::vector<std::uint8_t> columns;
  for (const char character : text) {
    if (!columns.empty())
      columns.push_back(0);
    const auto more = columns_of(character);
    columns.insert(columns.end(), more.begin(), more.end());
  }
  if (columns.empty())
    return clear();
  const auto pictures = static_cast<std::int64_t>(columns.size()) + side;
  begin({Text{color, std::move(columns)}, pictures, repeat, step_of(frames_per_second), now});
}

void Matrix::save_frame(int index, ByteView bytes) {
  constexpr std::size_t planes = 4;
  if (bytes.size() != planes * side)
    return;
  Frame frame{};
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const unsigned row = bytes[plane * side + static_cast<std::size_t>(y)];
        frame[index_of(x, y)] |= static_cast<std::uint8_t>((row >> (side - 1 - x) & 1U) << plane);
      }
  frames_.insert_or_assign(index, frame);
}

void Matrix::save_animation(int id, int frames_per_second, bool fade, std::vector<Color> palette,
                            std::vector<int> frames) {
  palette_ = palette;
  animations_.insert_or_assign(id, Animation{std::clamp(frames_per_second, 0, fastest), fade,
                                             std::move(palette), std::move(frames)});
}

bool Matrix::play(int id, bool loop, Instant now) {
  const auto found = animations_.find(id);
  if (found == animations_.end())
    return false;
  const auto& animation = found->second;
  palette_ = animation.palette;
  if (animation.frames.empty()) {
    clear();
    return true;
  }
  const int parts = pictures_in_frame(animation.frames_per_second, animation.fade);
  const auto frames = static_cast<std::int64_t>(animation.frames.size());
  // Played once, it ends with its last frame, which does not fade.
  const auto pictures = frames == 1 ? 1 : loop ? frames * parts : (frames - 1) * parts + 1;
  begin({animation, pictures, loop, step_of(animation.frames_per_second) / parts, now});
  return true;
}

bool Matrix::show_frame(int index) {
  if (frames_.find(index) == frames_.end())
    return false;
  film_.reset();
  constexpr std::size_t colors = 16;
  auto palette = palette_;
  for (std::size_t i = 0; palette_.empty() && i < colors; ++i) {
    const auto level = static_cast<std::uint8_t>(UINT8_MAX * i / (colors - 1));
    palette.push_back({level, level, level});
  }
  show(picture_of(index, palette));
  return true;
}

void Matrix::pause(Instant now) {
  if (!film_ || film_->paused)
    return;
  advance(now);
  if (!film_)
    return; // advance() has just ended it
  film_->paused = true;
  film_->played = now - film_->began;
}

void Matrix::resume(Instant now) {
  if (!film_ || !film_->paused)
    return;
  film_->paused = false;
  film_->began = now - film_->played;
}

void Matrix::forget() {
  film_.reset();
  frames_.clear();
  animations_.clear();
  palette_.clear();
}

std::vector<int> Matrix::frames() const {
  std::vector<int> all;
  for (const auto& [index, frame] : frames_)
    all.push_back(index);
  return all;
}

// Time.

void Matrix::advance(Instant now) {
  if (now < next_event())
    return;
  auto& film = *film_;
  film.at = (now - film.began) / film.step;
  const bool ends = !film.loops && film.at >= film.pictures - 1;
  const auto step = ends ? film.pictures - 1 : film.at % film.pictures;
  show(std::visit([&](const auto& what) { return picture_of(what, step); }, film.what));
  if (ends)
    film_.reset();
}

Instant Matrix::next_event() const {
  return film_ && !film_->paused ? film_->began + (film_->at + 1) * film_->step : never;
}

std::string hex_of(const Matrix::Pixels& pixels) {
  std::string text;
  for (const auto& color : pixels)
    fmt::format_to(std::back_inserter(text), "{:02X}{:02X}{:02X}", color.red, color.green,
                   color.blue);
  return text;
}

Matrix::Pixels filled(Color color) {
  Matrix::Pixels picture;
  picture.fill(color);
  return picture;
}

} // namespace orb::vm
