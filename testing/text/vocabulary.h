#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

// The words of test files. The rows, and what their columns mean, are in
// testing/text/vocabulary.def.

namespace orb::testing {

/// Where a line of a test file may stand.
enum class Stands : std::uint8_t { Head, Anywhere, InTest };

/// What begins a line.
enum class LineWord : std::uint8_t {
#define ORB_TEST_LINE(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_TEST_LINE
};

/// What a row of each table has.
struct WordInfo {
  std::string_view word;
  std::string_view operands; ///< empty where it takes none
  std::string_view summary;
  std::string_view example; ///< a whole line
};

struct LineInfo : WordInfo {
  Stands stands = Stands::InTest;
};

inline constexpr auto line_words = std::to_array<LineInfo>({
#define ORB_TEST_LINE(name, word, stands, operands, summary, example)                              \
  {{word, operands, summary, example}, Stands::stands},
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
  State,  ///< true or not at each moment
  Stay,   ///< true at every moment
  Event,  ///< happens
  Output, ///< all that is printed
  End,    ///< the end itself
  Final,  ///< known when the run is over
};

/// Whether an expectation has an opposite.
enum class Never : std::uint8_t { No, Yes };

struct ExpectationInfo : WordInfo {
  Kind kind = Kind::State;
  Never never = Never::Yes;
};

inline constexpr auto expectations = std::to_array<ExpectationInfo>({
#define ORB_EXPECTATION(name, word, kind, never, operands, summary, example)                       \
  {{word, operands, summary, example}, Kind::kind, Never::never},
#include "testing/text/vocabulary.def"
#undef ORB_EXPECTATION
});

/// What says when.
enum class WhenWord : std::uint8_t {
#define ORB_TEST_WHEN(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_TEST_WHEN
};

inline constexpr auto when_words = std::to_array<WordInfo>({
#define ORB_TEST_WHEN(name, word, operands, summary, example) {word, operands, summary, example},
#include "testing/text/vocabulary.def"
#undef ORB_TEST_WHEN
});

/// What joins several of them.
enum class JoinWord : std::uint8_t {
#define ORB_TEST_JOIN(name, ...) name,
#include "testing/text/vocabulary.def"
#undef ORB_TEST_JOIN
};

inline constexpr auto join_words = std::to_array<WordInfo>({
#define ORB_TEST_JOIN(name, word, operands, summary, example) {word, operands, summary, example},
#include "testing/text/vocabulary.def"
#undef ORB_TEST_JOIN
});

constexpr const LineInfo& info(LineWord word) {
  return line_words[static_cast<std::size_t>(word)];
}
constexpr const ExpectationInfo& info(Word word) {
  return expectations[static_cast<std::size_t>(word)];
}
constexpr const WordInfo& info(JoinWord word) {
  return join_words[static_cast<std::size_t>(word)];
}

} // namespace orb::testing
