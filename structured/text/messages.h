#pragma once

#include "base/diagnostic.h"
#include "repair/idioms.h"
#include "structured/text/program.h"

#include <optional>
#include <string_view>

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
  Parenthesised, ///< `goroll(0, 80, 1)`
  SecondIndex,   ///< `a[1, 2]`, `a[1][2]`
};

/// Puts into words why a line does not parse; `found` is the token at which that shows.
Diagnostic explain(const Program& program, Reason reason, Span found);

/// A habit of another language that was taken all the same, with the word to write instead; an
/// empty `instead` has no fix.
Diagnostic habit(const Program& program, Span found, std::string_view instead, Message help = {});

/// `print 'hello'`: a text in single quotes, which is a comment.
Diagnostic single_quotes(const Program& program, Span text);

/// The finding about a word or sign of another language, or nothing where it is none that is known.
std::optional<Diagnostic> foreign(const Program& program, Span word, repair::Where where);

} // namespace orb::structured
