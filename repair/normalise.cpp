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
// The order matters: what is quoted is read before words, glued words before known ones.
constexpr auto table = std::to_array<Rewrite>({
    {all, drop_last_quote, R"(10 print "A is " A")", R"(10 print "A is " A)"},
    {all, close_block, "10 ]", "10 }"},
    {all, close_text, R"(10 print "hello')", R"(10 print "hello")"},
    {programs, truths, R"(10 while "True")", "10 while True"},
    {programs, texts_in_brackets, R"(10 print [longest hold] N)", R"(10 print "longest hold" N)"},
    {all, words_with_one_quote, R"(10 make "side 5)", "10 make side 5"},
    {all, drop_number_word, "10 marker no. 13", "10 marker 13"},
    {programs, drop_small_words, "10 let the course be 0", "10 let course be 0"},
    {programs, read_zeros, "10 goroll zéro,0,0", "10 goroll 0,0,0"},
    {basic, single_letters, "10 PP = W", "10 P = W"},
    {programs, drop_brackets, "10 (print A B)", "10 print A B"},
    {all, drop_colons, "10 if :n > 3", "10 if n > 3"},
    {all, read_branches, "10 ifelse A = 1 [B = 2] [B = 3]", "10 if A = 1 then B = 2 else B = 3"},
    {programs, read_shifted, "10 delay A 8 75", "10 delay A * 75"},
    {programs, join_words, "10 nex tB", "10 next B"},
    {programs, missed_name, "10 = A + 1", "10 A = A + 1"},
    {programs, close_by_key, "sub show(speed0", "sub show(speed)"},
    {programs, comma_for_point, "10 goroll A * 10.60,1", "10 goroll A * 10, 60,1"},
    {structured, decimal_comma, "leg(90, 0,6s)", "leg(90, 0.6s)"},
    {programs, missed_signs, "10 A 0 A + 1", "10 A = A + 1"},
    {programs, missed_else, "10 if A = 1 then B = 270 B = 90", "10 if A = 1 then B = 270 else B = 90"},
    {structured, drop_types, "sub drive(time as integer)", "sub drive(time)"},
    {programs, read_thousands, "10 for A = 1 to 1.000", "10 for A = 1 to 1000"},
    {programs, read_hexadecimal, "10 for A = #4E to #62", "10 for A = 78 to 98"},
    {programs | test, plain_signs, "10 if A == 1 && B !== 2 then B = 3", "10 if A = 1 and B != 2 then B = 3"},
    {basic, part_line, "10 goto line180", "10 goto 180"},
    {basic, part_glued, "10 GOTO150", "10 goto 150"},
    {structured, part_for, "forn = 1 to 5", "for n = 1 to 5"},
    {structured, part_next, "nexti", "next i"},
    {structured, same_letters, "isRecord = 1", "is_record = 1"},
    {programs, drop_prefixes, "10 set_ledc(3)", "10 LEDC(3)"},
    {test, drop_objects, "ball.toss()", "toss"},
    {programs | macro, without_accents, "10 A = ábs(B)", "10 A = abs(B)"},
    {all, numbers_in_quotes, R"(10 data "222","121")", "10 data 222,121"},
    {structured, names_in_quotes, R"(state = "speed")", "state = speed"},
    {all, other_forms, "10 wartet 5", "10 warte 5"},
    {all, count_percents, "10 RGB 0, 60%, 100%", "10 RGB 0, 153, 255"},
    {programs, drop_sigils, "10 A% = B%", "10 A = B"},
    {all, compare_with_true, R"(10 if A = "true")", "10 if A = true"},
    {basic | macro | test, documented_spelling, "10 GOROLL 0,0,0", "10 goroll 0,0,0"},
    {basic, decimal_numbers, "10 delay 0x1F", "10 delay 31"},
    {basic, resolve_labels, "10 goto start", "10 goto 20"},
    {structured, drop_pronoun, "if it is speed then", "if speed then"},
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
