#include "vm/matrix.h"

#include "vm/ball.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace orb::vm {
namespace {

constexpr Color red{255, 0, 0};
constexpr Color blue{0, 0, 255};
constexpr Instant start{};

/// Draws the matrix as seen: rows from the top, `.` for a dark lamp, otherwise the first letter of
/// its colour.
std::string seen(const Matrix& matrix) {
  std::string text = "\n";
  for (int y = Matrix::side - 1; y >= 0; --y) {
    for (int x = 0; x < Matrix::side; ++x) {
      const auto color = matrix.pixels()[static_cast<std::size_t>(y * Matrix::side + x)];
      text += color == Color{} ? '.' : color == red ? 'r' : color == blue ? 'b' : '?';
    }
    text += '\n';
  }
  return text;
}

std::string dark() {
  return seen(Matrix{});
}

int lit(const Matrix& matrix) {
  int count = 0;
  for (const auto& color : matrix.pixels())
    count += color == Color{} ? 0 : 1;
  return count;
}

/// A frame with the same palette index everywhere.
Bytes plain_frame(unsigned index) {
  Bytes bytes;
  for (unsigned plane = 0; plane < 4; ++plane)
    bytes.insert(bytes.end(), Matrix::side, (index >> plane & 1U) != 0 ? 0xFF : 0x00);
  return bytes;
}

/// An animation of red, blue, red… with four frames a second.
Matrix blinker(bool fade = false) {
  Matrix matrix;
  matrix.save_frame(7, plain_frame(1));
  matrix.save_frame(9, plain_frame(2));
  matrix.save_animation(3, 4, fade, {Color{}, red, blue}, {7, 9});
  return matrix;
}

std::string played(Matrix& matrix) {
  std::string text;
  for (Instant at = start; text.size() < 40; at = matrix.next_event()) {
    matrix.advance(at);
    const auto color = matrix.pixels().front();
    text.push_back(color == red ? 'r' : color == blue ? 'b' : color == Color{} ? '.' : '~');
    if (matrix.next_event() == never) {
      text.push_back('|');
      break;
    }
  }
  return text;
}

TEST(Matrix, OnlyABoltHasOne) {
  for (const auto& robot : spec::robots)
    EXPECT_EQ(has_matrix(robot.robot),
              robot.robot == spec::Robot::Bolt || robot.robot == spec::Robot::BoltPlus)
        << robot.name;
}

TEST(Matrix, CountsFromTheBottomLeft) {
  Matrix matrix;
  matrix.pixel(0, 0, red);
  matrix.pixel(2, 1, blue);
  EXPECT_EQ(seen(matrix), "\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "..b.....\n"
                          "r.......\n");
  EXPECT_EQ(matrix.pixels()[8 + 2], blue);
}

TEST(Matrix, DrawsLinesAndRectangles) {
  Matrix matrix;
  matrix.rectangle(6, 7, 5, 4, blue);
  matrix.line(0, 0, 7, 0, red);
  matrix.line(4, 6, 0, 2, red);
  matrix.line(7, 5, 7, 2, red);
  EXPECT_EQ(seen(matrix), "\n"
                          ".....bb.\n"
                          "....rbb.\n"
                          "...r.bbr\n"
                          "..r..bbr\n"
                          ".r.....r\n"
                          "r......r\n"
                          "........\n"
                          "rrrrrrrr\n");
}

TEST(Matrix, ALineThatIsSteepHasALampInEachRow) {
  Matrix matrix;
  matrix.line(1, 0, 4, 7, red);
  EXPECT_EQ(seen(matrix), "\n"
                          "....r...\n"
                          "....r...\n"
                          "...r....\n"
                          "...r....\n"
                          "..r.....\n"
                          "..r.....\n"
                          ".r......\n"
                          ".r......\n");
  Matrix back;
  back.line(3, 3, 3, 3, red);
  EXPECT_EQ(lit(back), 1);
}

TEST(Matrix, LeavesOutWhatLiesBeside) {
  Matrix matrix;
  matrix.pixel(8, 0, red);
  matrix.pixel(0, -1, red);
  matrix.line(0, 0, 0, 8, red);
  matrix.rectangle(-1, 0, 3, 3, red);
  EXPECT_EQ(seen(matrix), dark());
}

TEST(Matrix, FillsAndClears) {
  Matrix matrix;
  matrix.fill(red);
  EXPECT_EQ(lit(matrix), 64);
  EXPECT_EQ(hex_of(matrix.pixels()).substr(0, 12), "FF0000FF0000");
  EXPECT_EQ(hex_of(matrix.pixels()).size(), 64 * 6U);
  EXPECT_EQ(matrix.pixels(), filled(red));
  matrix.clear();
  EXPECT_EQ(seen(matrix), dark());
}

TEST(Matrix, TurnsClockwise) {
  Matrix matrix;
  matrix.line(0, 0, 0, 7, red); // the left edge
  matrix.pixel(1, 7, blue);
  matrix.rotate(1);
  EXPECT_EQ(seen(matrix), "\n"
                          "rrrrrrrr\n"
                          ".......b\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n");
  matrix.rotate(2);
  EXPECT_EQ(matrix.pixels()[7], red);
  EXPECT_EQ(matrix.pixels()[6], blue);
  matrix.rotate(-1);
  EXPECT_EQ(matrix.pixels()[0], red);
  EXPECT_EQ(matrix.pixels()[8], blue);
  matrix.rotate(0);
  EXPECT_EQ(matrix.pixels()[7 * 8 + 1], blue);
  matrix.pixel(5, 0, blue); // drawing while rotated is rotated, too
  matrix.rotate(1);
  matrix.pixel(0, 0, blue);
  EXPECT_EQ(matrix.pixels()[7 * 8], blue);
  EXPECT_EQ(matrix.pixels()[2 * 8], blue);
}

TEST(Matrix, ShowsACharacter) {
  Matrix matrix;
  matrix.fill(blue);
  matrix.character(red, 'F');
  EXPECT_EQ(seen(matrix), "\n"
                          ".rrrrr..\n"
                          ".r......\n"
                          ".r......\n"
                          ".rrrr...\n"
                          ".r......\n"
                          ".r......\n"
                          ".r......\n"
                          "........\n");
}

TEST(Matrix, ANarrowCharacterStandsInTheMiddle) {
  Matrix matrix;
  matrix.character(red, '!');
  EXPECT_EQ(matrix.pixels()[7 * 8 + 3], red);
}

TEST(Matrix, HasAFormForEachPrintableCharacter) {
  std::set<std::string> forms;
  for (int code = 0; code < 256; ++code) {
    Matrix matrix;
    matrix.character(red, static_cast<char>(code));
    EXPECT_EQ(lit(matrix) == 0, code == ' ') << code;
    forms.insert(seen(matrix));
  }
  EXPECT_EQ(forms.size(), 95U);
}

TEST(Matrix, ScrollsATextOutOfSight) {
  Matrix matrix;
  matrix.scroll(red, 10, false, "T!", start);
  EXPECT_EQ(matrix.next_event(), start + 100ms);
  matrix.advance(start + 450ms);
  EXPECT_EQ(seen(matrix), "\n"
                          "...rrrrr\n"
                          ".....r..\n"
                          ".....r..\n"
                          ".....r..\n"
                          ".....r..\n"
                          ".....r..\n"
                          ".....r..\n"
                          "........\n");
  EXPECT_EQ(matrix.next_event(), start + 500ms);
  matrix.advance(start + 700ms);
  EXPECT_EQ(seen(matrix), "\n"
                          "rrrrr.r.\n"
                          "..r...r.\n"
                          "..r...r.\n"
                          "..r...r.\n"
                          "..r...r.\n"
                          "..r.....\n"
                          "..r...r.\n"
                          "........\n");
  matrix.advance(start + 1300ms);
  EXPECT_EQ(lit(matrix), 6);
  matrix.advance(start + 1400ms);
  EXPECT_EQ(seen(matrix), dark());
  EXPECT_EQ(matrix.next_event(), never);
}

TEST(Matrix, ATextThatIsRepeatedComesInAgain) {
  Matrix matrix;
  matrix.scroll(red, 10, true, "!", start);
  const auto first = seen(matrix);
  EXPECT_NE(first, dark());
  matrix.advance(start + 800ms); // one column, and seven lamps to go
  EXPECT_EQ(seen(matrix), dark());
  matrix.advance(start + 900ms);
  EXPECT_EQ(seen(matrix), first);
  matrix.advance(start + 900ms * 1000);
  EXPECT_EQ(seen(matrix), first);
}

TEST(Matrix, ATextWithoutSpeedOrLettersDoesNotMove) {
  Matrix matrix;
  matrix.scroll(red, 0, true, "!", start);
  EXPECT_EQ(lit(matrix), 6);
  EXPECT_EQ(matrix.next_event(), never);
  matrix.scroll(red, 10, true, "", start);
  EXPECT_EQ(seen(matrix), dark());
  EXPECT_EQ(matrix.next_event(), never);
  matrix.scroll(red, 200, false, "!", start);
  EXPECT_EQ(matrix.next_event(), start + Duration{1s} / 30);
}

TEST(Matrix, ReadsAFrame) {
  // Index 9 at the bottom left, 2 at the right end of the second row.
  Bytes bytes(32, 0);
  bytes[0] = 0x80;
  bytes[24] = 0x80;
  bytes[8 + 1] = 0x01;
  Matrix matrix;
  matrix.save_frame(300, bytes);
  std::vector<Color> palette(10);
  palette[9] = red;
  palette[2] = blue;
  matrix.save_animation(1, 0, false, palette, {300});
  EXPECT_TRUE(matrix.show_frame(300));
  EXPECT_EQ(seen(matrix), "\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          "........\n"
                          ".......b\n"
                          "r.......\n");
  bytes.pop_back();
  matrix.save_frame(301, bytes);
  EXPECT_FALSE(matrix.show_frame(301));
}

TEST(Matrix, AFrameWithoutAnimationIsGrey) {
  Matrix matrix;
  matrix.save_frame(0, plain_frame(5));
  EXPECT_TRUE(matrix.show_frame(0));
  EXPECT_EQ(matrix.pixels(), filled({85, 85, 85}));
}

TEST(Matrix, PlaysAnAnimationOnceOrForEver) {
  auto matrix = blinker();
  EXPECT_FALSE(matrix.play(2, true, start));
  EXPECT_EQ(seen(matrix), dark());
  EXPECT_TRUE(matrix.play(3, false, start));
  EXPECT_EQ(matrix.next_event(), start + 250ms);
  EXPECT_EQ(played(matrix), "rb|"); // the last frame stays
  EXPECT_TRUE(matrix.play(3, true, start));
  EXPECT_EQ(played(matrix), "rbrbrbrbrbrbrbrbrbrbrbrbrbrbrbrbrbrbrbrb");
  matrix.play(3, true, start);
  matrix.advance(start + 250ms * 1001);
  EXPECT_EQ(matrix.pixels(), filled(blue));
}

TEST(Matrix, FadesFromFrameToFrame) {
  auto matrix = blinker(true);
  matrix.play(3, false, start);
  EXPECT_EQ(played(matrix), "r~~~~~~b|"); // 30 pictures a second: 7 in the time of a frame
  matrix.play(3, true, start);
  matrix.advance(start + 3 * matrix.next_event().time_since_epoch());
  EXPECT_EQ(matrix.pixels(), filled({146, 0, 109}));
  matrix.play(3, true, start);
  EXPECT_EQ(played(matrix).substr(0, 15), "r~~~~~~b~~~~~~r");
}

TEST(Matrix, WhatCannotMoveStands) {
  auto matrix = blinker();
  matrix.save_animation(4, 0, true, {Color{}, red, blue}, {9, 7});
  EXPECT_TRUE(matrix.play(4, true, start));
  EXPECT_EQ(matrix.pixels(), filled(blue));
  EXPECT_EQ(matrix.next_event(), never);
  matrix.save_animation(5, 30, true, {Color{}, red}, {7});
  EXPECT_TRUE(matrix.play(5, true, start));
  EXPECT_EQ(matrix.pixels(), filled(red));
  EXPECT_EQ(matrix.next_event(), never);
  matrix.save_animation(6, 30, true, {red}, {});
  EXPECT_TRUE(matrix.play(6, true, start));
  EXPECT_EQ(seen(matrix), dark());
  std::vector<Color> palette{red, red, red};
  palette.pop_back();
  matrix.save_animation(7, 30, false, std::move(palette), {9, 1234}); // no such colour, no frame
  EXPECT_TRUE(matrix.play(7, true, start));
  EXPECT_EQ(played(matrix), std::string(40, '.'));
}

TEST(Matrix, StandsWhileItIsPaused) {
  auto matrix = blinker();
  matrix.play(3, true, start);
  matrix.advance(start + 250ms);
  matrix.pause(start + 400ms);
  EXPECT_EQ(matrix.next_event(), never);
  matrix.advance(start + 9s);
  EXPECT_EQ(matrix.pixels(), filled(blue));
  matrix.pause(start + 9s);
  matrix.resume(start + 10s);
  EXPECT_EQ(matrix.next_event(), start + 10100ms);
  matrix.resume(start + 11s);
  EXPECT_EQ(matrix.next_event(), start + 10100ms);
  matrix.advance(start + 10100ms);
  EXPECT_EQ(matrix.pixels(), filled(red));
}

TEST(Matrix, WhatIsDueIsShownBeforeAPause) {
  auto matrix = blinker();
  matrix.play(3, false, start);
  matrix.pause(start + 300ms); // it has already ended
  EXPECT_EQ(matrix.pixels(), filled(blue));
  matrix.resume(start + 1s);
  EXPECT_EQ(matrix.next_event(), never);
}

TEST(Matrix, DrawingEndsWhatPlays) {
  const auto ends = [](auto draw) {
    auto matrix = blinker();
    matrix.play(3, true, start);
    draw(matrix);
    return matrix.next_event() == never;
  };
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.fill(red); }));
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.pixel(1, 1, blue); }));
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.line(1, 1, 2, 2, blue); }));
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.character(red, 'A'); }));
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.show_frame(7); }));
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.clear(); }));
  EXPECT_TRUE(ends([](Matrix& matrix) { matrix.forget(); }));
  EXPECT_FALSE(ends([](Matrix& matrix) { matrix.pixel(8, 8, blue); }));
  EXPECT_FALSE(ends([](Matrix& matrix) { matrix.rotate(1); }));
  EXPECT_FALSE(ends([](Matrix& matrix) { matrix.show_frame(8); }));
}

TEST(Matrix, ForgetsWhatWasSaved) {
  auto matrix = blinker();
  matrix.play(3, true, start);
  matrix.forget();
  EXPECT_EQ(matrix.pixels(), filled(red));
  EXPECT_FALSE(matrix.play(3, true, start));
  EXPECT_FALSE(matrix.show_frame(7));
  matrix.save_frame(0, plain_frame(1));
  matrix.show_frame(0);
  EXPECT_EQ(matrix.pixels(), filled({17, 17, 17})); // no colours are left
}

TEST(Matrix, ABallTellsWhatItsMatrixShows) {
  struct Heard final : Observer {
    void on_event(Instant at, const Event& event) override {
      if (const auto* matrix = std::get_if<event::Matrix>(&event))
        pictures.emplace_back(at, matrix->pixels);
    }
    std::vector<std::pair<Instant, Matrix::Pixels>> pictures;
  } heard;
  BallOptions options;
  options.observer = &heard;
  Ball ball(options);
  ball.advance_to(start + 1s);
  EXPECT_TRUE(heard.pictures.empty());
  ball.show_matrix(filled(blue));
  ASSERT_EQ(heard.pictures.size(), 1U);
  EXPECT_EQ(heard.pictures[0], std::pair(start + 1s, filled(blue)));
}

// The result does not depend on how often it is looked at.
RC_GTEST_PROP(Matrix, DoesNotDependOnHowTimeIsCut, ()) {
  auto whole = blinker(*rc::gen::arbitrary<bool>());
  const bool text = *rc::gen::arbitrary<bool>();
  const bool loop = *rc::gen::arbitrary<bool>();
  if (text)
    whole.scroll(red, *rc::gen::inRange(0, 31), loop, "orb", start);
  else
    whole.play(3, loop, start);
  auto cut = whole;
  const auto pieces = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 700));
  Instant at = start;
  for (const int piece : pieces) {
    at += std::chrono::milliseconds{piece};
    cut.advance(at);
  }
  whole.advance(at);
  RC_ASSERT(seen(cut) == seen(whole));
  RC_ASSERT(cut.next_event() == whole.next_event());
  RC_ASSERT(whole.next_event() > at);
}

} // namespace
} // namespace orb::vm
