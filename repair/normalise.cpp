#include "repair/normalise.h"

#include <array>

namespace orb::repair {
namespace {

using in::all;
using in::basic;
using in::macro;
using in::programs;
using in::structured;
using in::test;

// clang-format off
// The order matters: quotes are resolved before words, joined words before known ones.
constexpr auto table = std::to_array<Rewrite>({
    {all, close_block, "10 ]", "10 }"},
    {all, close_text, R"(10 print "hello')", R"(10 print "hello")"},
    {all, words_with_one_quote, R"(10 make "side 5)", "10 make side 5"},
    {programs, drop_small_words, "10 let the course be 0", "10 let course be 0"},
    {basic, single_letters, "10 PP = W", "10 P = W"},
    {all, drop_colons, "10 if :n > 3", "10 if n > 3"},
    {programs, join_words, "10 nex tB", "10 next B"},
    {programs, comma_for_point, "10 goroll A * 10.60,1", "10 goroll A * 10, 60,1"},
    {programs, missed_signs, "10 A 0 A + 1", "10 A = A + 1"},
    {structured, drop_types, "sub drive(time as integer)", "sub drive(time)"},
    {programs, read_thousands, "10 for A = 1 to 1.000", "10 for A = 1 to 1000"},
    {programs | test, plain_signs, "10 if A == 1 && B !== 2 then B = 3", "10 if A = 1 and B != 2 then B = 3"},
    {programs, drop_prefixes, "10 set_ledc(3)", "10 LEDC(3)"},
    {all, other_forms, "10 wartet 5", "10 warte 5"},
    {programs, drop_sigils, "10 A% = B%", "10 A = B"},
    {all, compare_with_true, R"(10 if A = "true")", "10 if A = true"},
    {basic | macro | test, documented_spelling, "10 GOROLL 0,0,0", "10 goroll 0,0,0"},
    {basic, decimal_numbers, "10 delay 0x1F", "10 delay 31"},
    {structured, index_arrays, "speed = values(3)", "speed = values[3]"},
    {structured, own_words, "heading = richtung", "heading = direction"},
});
// clang-format on

} // namespace

std::span<const Rewrite> rewrites() {
  return table;
}

void normalise(Line& line) {
  for (const auto& rewrite : table)
    if ((rewrite.languages & in::bit(line.language())) != 0)
      rewrite.apply(line);
}

} // namespace orb::repair
