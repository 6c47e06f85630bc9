// Offered lines keep what was written: words planted into a line with one slip must be in every
// line that is offered for it.

#include "base/random.h"
#include "compiler/check.h"
#include "structured/compile.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {
namespace {

/// A statement with planted values, and the values.
struct Planted {
  std::string text;
  std::vector<std::string> words;
};

enum class Dialect : std::uint8_t { Numbered, Structured };

class Planter {
public:
  Planter(std::uint64_t seed, Dialect dialect) : random_{seed}, dialect_(dialect) {}

  Planted plant() {
    words_.clear();
    auto text = statement();
    return {std::move(text), words_};
  }

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.below(n)); }

private:
  std::string keep(std::string word) {
    words_.push_back(word);
    return word;
  }

  std::string number() { return keep(std::to_string(21 + below(200))); }

  std::string value() {
    const bool numbered = dialect_ == Dialect::Numbered;
    switch (below(5)) {
    case 0: return keep(numbered ? "A" : "pace");
    case 1: {
      const auto of = number();
      keep("rnd");
      return numbered ? "rnd " + of : "rnd(" + of + ")";
    }
    case 2: {
      keep("abs");
      keep("pitch");
      return numbered ? "abs pitch" : "abs(pitch)";
    }
    default: return number();
    }
  }

  std::string statement() {
    switch (below(6)) {
    case 0: return fmt::format("RGB {}, {}, {}", value(), value(), value());
    case 1: return fmt::format("goroll {}, {}, 1", value(), value());
    case 2: return "delay " + value();
    case 3: return "backLED " + value();
    case 4: return fmt::format("print \"{}\" {}", keep("planted"), value());
    default:
      return fmt::format("{} = {} + {}", dialect_ == Dialect::Numbered ? "B" : "way", value(),
                         number());
    }
  }

  Random random_;
  Dialect dialect_;
  std::vector<std::string> words_;
};

/// Makes one slip, as beginners do; leaves the line unchanged if it does not apply.
std::string slip(std::string line, std::size_t kind) {
  const auto replace = [&](std::string_view from, std::string_view to) {
    if (const auto at = line.find(from); at != std::string::npos)
      line.replace(at, from.size(), to);
  };
  switch (kind) {
  case 0: replace(",", ""); break;
  case 1: replace(" ", " = "); break;
  case 2: line += ")"; break;
  case 3: line += ";"; break;
  case 4: line = "set " + line; break;
  case 5: line[0] = static_cast<char>(line[0] ^ 0x20); break; // the other case
  case 6: replace(", ", " and "); break;
  case 7: replace("\"", "'"); break;
  case 8: replace("(", " "); break;
  case 9: replace(")", ""); break;
  case 10: line = "please " + line; break;
  case 11: line.erase(1, 1); break;
  default: line += " now"; break;
  }
  return line;
}
constexpr std::size_t slips = 13;

/// Returns the lines that a finding offers.
std::vector<std::string> offered(const Diagnostic& finding) {
  std::vector<std::string> lines;
  const auto said = in_english(finding.help);
  std::string_view help = said;
  if (!help.starts_with("write `"))
    return lines;
  for (auto at = help.find('`'); at != std::string_view::npos; at = help.find('`')) {
    help.remove_prefix(at + 1);
    const auto end = std::min(help.find('`'), help.size());
    lines.emplace_back(help.substr(0, end));
    help.remove_prefix(std::min(end + 1, help.size()));
  }
  return lines;
}

std::size_t times(std::string_view text, std::string_view word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + word.size()))
    ++n;
  return n;
}

/// Returns a planted word that the line has lost; empty if there is none.
std::string lost(const Planted& planted, const std::string& line) {
  for (const auto& word : planted.words)
    if (times(line, word) <
        static_cast<std::size_t>(std::count(planted.words.begin(), planted.words.end(), word)))
      return word;
  return {};
}

void expect_kept(Dialect dialect, std::uint64_t seed) {
  Planter planter(seed, dialect);
  const auto planted = planter.plant();
  const auto line = slip(planted.text, planter.below(slips));
  const bool numbered = dialect == Dialect::Numbered;
  const auto text = numbered ? fmt::format("10 A = 20\n20 {}\n30 print A, B\n", line)
                             : fmt::format("pace = 20\nway = 3\n{}\nprint pace, way\n", line);
  NoFiles files;
  const auto findings =
      numbered ? compiler::check(text, {}).diagnostics
               : findings_by_file(compile("a.orb", "a.orb", text, {}, files).program).front();
  for (const auto& finding : findings) {
    const auto lines = offered(finding);
    const bool whole = std::any_of(lines.begin(), lines.end(), [&](const std::string& one) {
      return one.size() + 4 > planted.text.size() / 2;
    });
    if (lines.size() != 1 || !whole || !is_error(finding))
      continue;
    EXPECT_EQ(lost(planted, lines[0]), "") << text << in_english(finding.message) << "\n"
                                           << in_english(finding.help);
  }
}

TEST(Offers, NumberedLinesLoseNothing) {
  for (std::uint64_t seed = 1; seed <= 600; ++seed)
    expect_kept(Dialect::Numbered, seed);
}

TEST(Offers, StructuredLinesLoseNothing) {
  for (std::uint64_t seed = 1; seed <= 600; ++seed)
    expect_kept(Dialect::Structured, seed);
}

} // namespace
} // namespace orb::structured
