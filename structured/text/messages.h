#pragma once

#include "base/diagnostic.h"
#include "structured/text/program.h"

#include <cstdint>

namespace orb::structured {

/// Why a line does not parse: at most one reason per line.
enum class Reason : std::uint8_t {
  Trailing, ///< text after a complete statement
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
  NotAStatement,  ///< a statement begins with a word that cannot begin one
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

/// Explains why a line does not parse; `found` is the token where the error shows.
Diagnostic explain(const Program& program, Reason reason, Span found);

} // namespace orb::structured
