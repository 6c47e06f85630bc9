#pragma once

// Private to testing/.

#include "repair/tokens.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Lines of other test frameworks, in the words of test files as far as their grammar goes; what the
// words mean is not asked here.

namespace orb::testing {

/// `expect(color).not.toBe("red").within(3000)` as `never color red within 3s`, `at(8000).shake()`
/// as `at 8s shake`; empty where a line is no such chain of calls.
repair::Tokens words_of_chain(const repair::Tokens& line);

/// Texts, colours, lengths and bounds as test files write them: `print [a b]` is `print "a b"`,
/// `distance >= 1m and distance <= 2m` is `distance 1m..2m`, `6in` is `15cm`.
repair::Tokens with_plain_values(const repair::Tokens& line);

/// Without the signs of YAML and JSON: `at: 1s push: [90, 120]`.
repair::Tokens without_signs(const repair::Tokens& line);

/// Whether a word says that something is printed, in any of the languages.
bool says_print(const repair::Token& token);

/// Places in centimetres without their unit, as `beyond` and `wall` take them: `x>0.7m` is `x>70`;
/// doubled relations once.
repair::Tokens plain_places(const repair::Tokens& line);

/// Units as test files write them: `8 metres` as `8m`.
repair::Tokens with_units(const repair::Tokens& line);

/// `from 2s to 3s` as `during 2s..3s`.
repair::Tokens with_spans(const repair::Tokens& line);

/// `ON TIMER(4) push`, `when timer = 4s push` and `at (ms) 500`: a time as test files say it.
repair::Tokens with_times(repair::Tokens line);

/// `expect.not.moving();`, `wall.y = -30`: words without the points and brackets between them.
repair::Tokens without_points(repair::Tokens line);

/// What `run police.macro`, `backdrop ../hall.svg` and `course = "hall.svg";` name, as test files
/// say it: `program police.macro`. Empty where a line names no file.
std::string line_of_file(const repair::Tokens& line);

} // namespace orb::testing
