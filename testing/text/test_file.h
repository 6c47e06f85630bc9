#pragma once

#include "base/diagnostic.h"
#include "base/source.h"
#include "base/time.h"
#include "compiler/lint/lint.h"
#include "spec/basic.h"
#include "spec/firmware.h"
#include "testing/text/pattern.h"
#include "testing/text/vocabulary.h"
#include "vm/stimulus.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// A test file as a value: what it says, and its errors. testing/suite.h looks up what it names
// (programs, zones, variables).

namespace orb::testing {

/// The time limit of a run unless the file sets one.
inline constexpr Duration default_bound = 60s;

/// A word of the file, kept for findings about what it names.
struct Named {
  std::string text;
  Span span;
};

/// When to judge an expectation.
struct When {
  enum class Kind : std::uint8_t {
    AnyTime, ///< at some moment of the run; with `never`: at none
    Within,  ///< at some moment until `to`
    At,      ///< at `to`
    AtEnd,
    During, ///< at every moment from `from` to `to`
  };
  Kind kind = Kind::AnyTime;
  Duration from{};
  Duration to{};
};

/// How often something has to happen.
struct Times {
  std::uint64_t least = 1;
  std::uint64_t most = UINT64_MAX;
};

/// How to compare a printed line.
enum class Match : std::uint8_t { Whole, Part, Pattern };

/// The order of an expectation and another event.
enum class Order : std::uint8_t { Free, After, Before };

/// Direction of `beyond`.
enum class Side : std::uint8_t { AboveX, BelowX, AboveY, BelowY };

/// What has to happen, or must never. The word decides which members apply. Large because it has
/// the operands of every word.
struct Expectation {
  Word word = Word::Error;
  bool never = false;
  Span span;              ///< the line, without its comment and surrounding blanks
  std::uint32_t line = 0; ///< 0 for the implicit `never error` of every test
  When when;

  Match match = Match::Whole;             ///< Print
  std::string text;                       ///< Print; the words for an error or a colour
  std::shared_ptr<const Pattern> pattern; ///< Print, for Match::Pattern
  std::vector<std::string> texts;         ///< Prints
  Times times;                            ///< events
  double x = 0;                           ///< Near
  double y = 0;
  double by = 0;                 ///< Near, Heading, Color
  double least = 0;              ///< Speed, Distance, BackLed; Lines and Bytes: below `most`
  double most = 0;               ///< the upper end; the only value of Beyond, Heading and Variable
  Side side = Side::AboveX;      ///< Beyond
  std::vector<vm::Color> colors; ///< Color: any of these
  int number = 0;                ///< Marker
  std::optional<spec::BasicError> error; ///< Error: nothing means any
  Named name;                            ///< of a zone, a macro or a variable; empty if not given
  std::optional<std::size_t> ball;       ///< index into TestFile::balls; nothing means all
  std::optional<std::size_t> other_ball; ///< Near: index of a ball, in place of x and y

  std::vector<Expectation> joined; ///< states that are true at the same moment
  Duration lasts{};                ///< for states: how long without a break
  Order order = Order::Free;
  std::shared_ptr<const Expectation> other; ///< null for Order::Free
  std::optional<Duration> lag;              ///< After: delay after the other one …
  Duration lag_by{};                        ///< … and its tolerance
};

/// Upper limit of seeds in a test: their results stay in memory until all are known.
inline constexpr std::uint64_t most_seeds = 1'000'000;

/// First and last, both included.
struct Seeds {
  std::uint64_t first = 1;
  std::uint64_t last = 1;

  std::uint64_t count() const { return last - first + 1; }
};

struct Test {
  Named name;
  std::uint32_t line = 1;
  int points = 1;
  Seeds seeds;
  Duration bound = default_bound;
  std::vector<vm::TimedStimulus> stimuli;  ///< including those of the head
  std::vector<std::string> stimulus_lines; ///< the same as written, for `--stimulus`
  std::vector<Expectation> expectations;   ///< as written, followed by the implicit one
};

/// A ball of a room.
struct TestBall {
  Named name;
  Named program;
  vm::Placement start;
};

struct TestFile {
  std::optional<Named> program;
  std::vector<TestBall> balls; ///< of the room; empty if a single ball is tested
  std::vector<Named> with;
  std::optional<Named> course;
  compiler::Target target;
  std::string target_word; ///< as written; empty means the default
  spec::Firmware firmware = spec::default_firmware;
  std::vector<Test> tests;
  std::vector<Diagnostic> diagnostics;
};

/// Reads a test file. Accepts any text; reports lines that it cannot read and leaves them out.
TestFile parse(const Source& source);

/// Reads `2..5` or `7`; nothing for other texts and for ranges that run backwards. Does not check
/// `most_seeds`.
std::optional<Seeds> parse_seeds(std::string_view text);

} // namespace orb::testing
