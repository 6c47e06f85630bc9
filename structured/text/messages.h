#pragma once

#include "base/diagnostic.h"
#include "structured/text/program.h"

#include <cstdint>

namespace orb::structured {

/// Why a line does not parse: at most one for each line.
enum class Reason : std::uint8_t {
  Trailing, ///< something stands after a complete statement
  ExpectedStatement,
  ExpectedExpression,
  ExpectedPlace,
  ExpectedName,
  ExpectedEquals,
  ExpectedThen,
  ExpectedTo,
  ExpectedComma,
  ExpectedBracket, ///< `[` or `]`
  ExpectedParenthesis,
  ExpectedOperand, ///< `abs` without parentheses
  ExpectedOne,     ///< `rnd(1, 6)`
  ExpectedTwo,     ///< `max(1)`
  ExpectedQuote,
  ExpectedFile,
  NotAStatement,  ///< a statement begins with a word that begins none
  NakedArguments, ///< `leg 3`
  TooManyArguments,
  ReadOnly,
  Reserved,
  NameTooLong,
  BadNumber,
  FractionOfMillisecond,
  TooDeep,
  NestedIf,
  BlockInOneLine,
  LineNumber,
  Gosub,
  On,
  SingleQuotes, ///< `print 'hello'`, which is a comment
  SecondIndex,  ///< `a[1, 2]`, `a[1][2]`
};

/// Puts into words why a line does not parse; `found` is the token at which that shows.
Diagnostic explain(const Program& program, Reason reason, Span found);

} // namespace orb::structured
