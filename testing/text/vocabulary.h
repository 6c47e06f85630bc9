#pragma once

#include "base/slots.h"
#include "spec/ball.h"
#include "testing/text/texts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

// The words of test files. testing/text/vocabulary.def has the rows and describes their columns.

namespace orb::testing {

/// Where a line of a test file may appear.
enum class Stands : std::uint8_t { Head, Anywhere, InTest };

/// The words that begin a line.
enum class LineWord : std::uint8_t {
#define ORB_TEST_LINE(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_TEST_LINE
};

/// The units of lengths in test files.
inline constexpr std::array length_units{unit::cm, unit::mm, unit::m};

/// The slots of these words.
namespace slot {
using namespace orb::slot;

inline constexpr std::array speed_units{unit::cm_s, unit::m_s};
inline constexpr std::int64_t most_times = 1'000'000'000;
inline constexpr std::int64_t most_points = 1000;
inline constexpr std::array ones{unit::one};
inline constexpr std::array degrees{unit::deg};

constexpr Slot range(std::string_view shown, const Row<>& called, std::span<const Unit> units,
                     std::string_view usual) {
  return {.kind = Kind::Range, .shown = shown, .called = &called, .units = units, .usual = usual};
}

// clang-format off
inline constexpr Slot below = orb::slot::whole("N", file_texts::Limit, 1, most_times).after("<").like("500");
inline constexpr Slot brightness{Kind::Range, "A..B", &file_texts::Brightness, 0, spec::ball::greatest, ones, "0..255"};
inline constexpr Slot count = orb::slot::whole("N", file_texts::Count, 0, most_times);
inline constexpr Slot distance_by{Kind::Length, "LENGTH", &file_texts::Distance, 0, 0, length_units, "12cm", {}, "by"};
inline constexpr Slot files{.kind = Kind::File, .shown = "FILE", .called = &file_texts::FileName, .repeats = true};
inline constexpr Slot heading_by{Kind::Number, "DEGREES", &file_texts::Tolerance, 0, spec::ball::full_circle / 2, degrees, "5", {}, "by"};
inline constexpr Slot lag_by = word(Kind::Time, "TIME", file_texts::Tolerance).like("200ms").after("by");
inline constexpr Slot match = word(Kind::Match, "\"TEXT\"|~\"PART\"|/PATTERN/", file_texts::MatchedText);
inline constexpr Slot place_or_ball{Kind::Place, "X,Y|BALL"};
inline constexpr Slot points = orb::slot::whole("N", file_texts::NumberOfPoints, 0, most_points).after("points").or_none();
inline constexpr Slot seeds = word(Kind::Seeds, "A..B", file_texts::Seeds).like("1..20");
inline constexpr Slot side{Kind::Axis, "x>CM|x<CM|y>CM|y<CM", nullptr, 0, 0, length_units, "x>70", "><"};
inline constexpr Slot test_name = word(Kind::Text, "\"NAME\"", file_texts::TestName);
inline constexpr Slot time_or_end{.kind = Kind::Time, .shown = "TIME|end", .called = &file_texts::Time, .words = "end"};
inline constexpr Slot time_span = word(Kind::TimeSpan, "TIME..TIME", file_texts::TimeSpan).like("2s..3s");
inline constexpr Slot times = rest("N times|A to B times").or_none();
inline constexpr Slot when = rest("WHEN").or_none();
inline constexpr Slot zone = word(Kind::Zone, "ZONE", file_texts::ZoneName);
// clang-format on
} // namespace slot

/// The columns shared by all tables.
struct WordInfo {
  std::string_view word;
  Slots slots;
  std::string_view summary;
  std::string_view example; ///< a whole line
};

struct LineInfo : WordInfo {
  Stands stands = Stands::InTest;
};

inline constexpr auto line_words = std::to_array<LineInfo>({
#define ORB_TEST_LINE(name, word, stands, slots, summary, example)                                 \
  {{word, slots, summary, example}, Stands::stands},
#include "testing/text/vocabulary.def"
#undef ORB_TEST_LINE
});

/// What can be expected.
enum class Word : std::uint8_t {
#define ORB_EXPECTATION(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_EXPECTATION
};

/// How an expectation relates to time.
enum class Kind : std::uint8_t {
  State,  ///< true or false at each moment
  Stay,   ///< true at every moment
  Event,  ///< happens
  Output, ///< everything printed
  End,    ///< the end of the run
  Final,  ///< known only after the run
};

/// Tells if `never` may precede an expectation.
enum class Never : std::uint8_t { No, Yes };

struct ExpectationInfo : WordInfo {
  Kind kind = Kind::State;
  Never never = Never::Yes;
};

inline constexpr auto expectations = std::to_array<ExpectationInfo>({
#define ORB_EXPECTATION(name, word, kind, never, slots, summary, example)                          \
  {{word, slots, summary, example}, Kind::kind, Never::never},
#include "testing/text/vocabulary.def"
#undef ORB_EXPECTATION
});

/// The words that say when.
enum class WhenWord : std::uint8_t {
#define ORB_TEST_WHEN(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_TEST_WHEN
};

inline constexpr auto when_words = std::to_array<WordInfo>({
#define ORB_TEST_WHEN(name, word, slots, summary, example) {word, slots, summary, example},
#include "testing/text/vocabulary.def"
#undef ORB_TEST_WHEN
});

/// The words that join expectations.
enum class JoinWord : std::uint8_t {
#define ORB_TEST_JOIN(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_TEST_JOIN
};

inline constexpr auto join_words = std::to_array<WordInfo>({
#define ORB_TEST_JOIN(name, word, slots, summary, example) {word, slots, summary, example},
#include "testing/text/vocabulary.def"
#undef ORB_TEST_JOIN
});

/// The words that precede values: `by`, `points`.
std::vector<std::string_view> operand_words();

constexpr const LineInfo& info(LineWord word) {
  return line_words[static_cast<std::size_t>(word)];
}
constexpr const ExpectationInfo& info(Word word) {
  return expectations[static_cast<std::size_t>(word)];
}
constexpr const WordInfo& info(WhenWord word) {
  return when_words[static_cast<std::size_t>(word)];
}
constexpr const WordInfo& info(JoinWord word) {
  return join_words[static_cast<std::size_t>(word)];
}

} // namespace orb::testing
