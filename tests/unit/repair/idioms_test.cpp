#include "repair/idioms.h"

#include "repair/texts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::repair {
namespace {

constexpr auto rows = std::to_array<Idiom>({
#define ORB_IDIOM(where, patterns, basic, structured, macro, test, ...)                            \
  {Where::where, patterns, basic, structured, macro, test},
#include "repair/idioms.def"
});

template <Hole... Kinds>
constexpr std::size_t count_holes(const Row<Kinds...>&) {
  return sizeof...(Kinds);
}

struct HintRow {
  Hint hint;
  std::size_t holes;
};

/// Hints, and the words of other languages, which have the same columns.
constexpr auto hints = std::to_array<HintRow>({
#define ORB_HINT(patterns, text, basic, structured, ...)                                           \
  {{patterns, &texts::text, basic, structured, "" __VA_ARGS__}, count_holes(texts::text)},
#define ORB_WHOSE(patterns, language, text, basic, structured)                                     \
  ORB_HINT(patterns, text, basic, structured)
#include "repair/idioms.def"
});

std::vector<std::string> parted(std::string_view text, std::string_view by) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(by, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + by.size();
  }
  return parts;
}

std::set<char> holes_of(std::string_view pattern) {
  std::set<char> holes;
  for (const auto& part : parted(pattern, " "))
    if (part.size() == 2 && part[0] == '$' && std::islower(static_cast<unsigned char>(part[1])))
      holes.insert(part[1]);
  return holes;
}

/// Returns the holes that each place of a form needs: one of `{a}{n}`, all of `{dice:a,b}`.
std::vector<std::vector<std::string>> needs_of(std::string_view form) {
  std::vector<std::vector<std::string>> needs;
  bool beside = false; // the previous place ended here
  for (std::size_t at = 0; at < form.size(); ++at) {
    if (form[at] != '{' || form.substr(at, 2) == "{{") {
      at += form.substr(at, 2) == "{{" ? 1 : 0;
      beside = false;
      continue;
    }
    const auto end = form.find('}', at);
    auto inner = form.substr(at + 1, end - at - 1);
    const auto colon = inner.find(':');
    std::string holes;
    const bool may_lack = inner == "zero:e"; // a missing value is 0
    if ((colon != std::string_view::npos || inner.size() == 1) && !may_lack)
      for (const auto& hole : parted(inner.substr(colon + 1), ","))
        holes += hole;
    if (!holes.empty() && holes != "*") {
      if (!beside)
        needs.emplace_back();
      needs.back().push_back(holes);
    }
    beside = !holes.empty();
    at = end;
  }
  return needs;
}

// A form with a hole that its pattern lacks would write a line with a gap.
TEST(Idioms, FormsNameWhatTheirPatternsHold) {
  for (const auto& row : rows)
    for (const auto& pattern : parted(row.patterns, " ;; ")) {
      const auto holes = holes_of(pattern);
      for (const auto form : {row.basic, row.structured, row.macro, row.test})
        for (const auto& place : needs_of(form))
          EXPECT_TRUE(std::any_of(place.begin(), place.end(),
                                  [&](const std::string& all) {
                                    return std::all_of(all.begin(), all.end(), [&](char hole) {
                                      return hole == 'r' || holes.count(hole) > 0;
                                    });
                                  }))
              << pattern << "  ->  " << form;
    }
}

TEST(Idioms, HintsFillTheHolesOfTheirTexts) {
  for (const auto& [hint, holes] : hints)
    for (const auto form : {hint.basic, hint.structured, hint.macro})
      if (!form.empty()) {
        EXPECT_EQ(form == "-" ? 0 : parted(form, " ;; ").size(), holes)
            << hint.patterns << "  ->  " << form;
      }
}

} // namespace
} // namespace orb::repair
