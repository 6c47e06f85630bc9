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

// A test file as a value: what it says, and what is wrong with it. What it names (programs, zones,
// variables) is looked up by testing/suite.h.

namespace orb::testing {

/// What a run is stopped after that says nothing else.
inline constexpr Duration default_bound = 60s;

/// A word of the file, for findings about what it names.
struct Named {
  std::string text;
  Span span;
};

/// When an expectation is judged.
struct When {
  enum class Kind : std::uint8_t {
    AnyTime, ///< at some moment of the run; of `never`: at none
    Within,  ///< at some moment until `to`
    At,      ///< at `to`
    AtEnd,
    During, ///< at every moment from `from` to `to`
  };
  Kind kind = Kind::AnyTime;
  Duration from{};
  Duration to{};
};

/// How often something happens.
struct Times {
  std::uint64_t least = 1;
  std::uint64_t most = UINT64_MAX;
};

/// How a printed line is compared.
enum class Match : std::uint8_t { Whole, Part, Pattern };

/// How an expectation stands to something else that happens.
enum class Order : std::uint8_t { Free, After, Before };

/// The side of `beyond`.
enum class Side : std::uint8_t { AboveX, BelowX, AboveY, BelowY };

/// What shall happen, or never. Which members count depends on the word.
struct Expectation {
  Word word = Word::Error;
  bool never = false;
  Span span;              ///< the line without blanks at its ends and without its comment
  std::uint32_t line = 0; ///< 0 for the `never error` that every test has silently
  When when;

  Match match = Match::Whole;             ///< Print
  std::string text;                       ///< Print; the words for an error or a colour
  std::shared_ptr<const Pattern> pattern; ///< Print with Match::Pattern
  std::vector<std::string> texts;         ///< Prints
  Times times;                            ///< events
  double x = 0;                           ///< Near
  double y = 0;
  double by = 0;                 ///< Near, Heading, Color
  double least = 0;              ///< Speed, Distance, BackLed; Lines and Bytes: below `most`
  double most = 0;               ///< the same; the one value of Beyond, Heading and Variable
  Side side = Side::AboveX;      ///< Beyond
  std::vector<vm::Color> colors; ///< Color: any of these
  int number = 0;                ///< Marker
  std::optional<spec::BasicError> error; ///< Error: nothing for any
  Named name;                      ///< of a zone, a macro or a variable; empty where none is given
  std::optional<std::size_t> ball; ///< of whom it is expected, of TestFile::balls; nothing: of all
  std::optional<std::size_t> other_ball; ///< Near: in place of x and y

  std::vector<Expectation> joined; ///< states that are true at the same moment
  Duration lasts{};                ///< states: true for so long without a break
  Order order = Order::Free;
  std::shared_ptr<const Expectation> other; ///< null where it is Free
  std::optional<Duration> lag;              ///< After: how long after the other one …
  Duration lag_by{};                        ///< … more or less
};

/// A test has no more seeds than this: their results are kept until all are known.
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
  std::vector<vm::TimedStimulus> stimuli;  ///< of the head, too
  std::vector<std::string> stimulus_lines; ///< the same as they are written, for `--stimulus`
  std::vector<Expectation> expectations;   ///< as written, then the silent one
};

/// A ball of a room.
struct TestBall {
  Named name;
  Named program;
  vm::Placement start;
};

struct TestFile {
  std::optional<Named> program;
  std::vector<TestBall> balls; ///< of the room; empty where one ball is tested alone
  std::vector<Named> with;
  std::optional<Named> course;
  compiler::Target target;
  std::string target_word; ///< as written; empty for the default
  spec::Firmware firmware = spec::default_firmware;
  std::vector<Test> tests;
  std::vector<Diagnostic> diagnostics;
};

/// Reads a test file. Any text will do; lines that cannot be read are left out and told.
TestFile parse(const Source& source);

/// `2..5` or `7`; nothing where the text is something else, or runs backwards. They may be more
/// than `most_seeds`.
std::optional<Seeds> parse_seeds(std::string_view text);

} // namespace orb::testing
