#include "compiler/text/parse_basic.h"

#include "compiler/text/basic_words.h"
#include "compiler/text/print.h"

#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace orb::compiler {
namespace {

using spec::BasicError;
using spec::Statement;

/// Returns the statement of a one-line program.
struct One {
  std::string text;
  Program program;
  const StatementNode& statement;

  explicit One(std::string line)
      : text(std::move(line)), program(parse(text)), statement(program.statements.at(0)) {}
};

std::optional<BasicError> error_of(const std::string& line) {
  return One(line).statement.error;
}

Statement kind_of(const std::string& line) {
  const One one(line);
  EXPECT_FALSE(one.statement.error) << line;
  return one.statement.kind;
}

/// Prints an expression with all parentheses, to show precedence.
std::string bracketed(const Program& program, std::uint32_t root) {
  const auto& node = program.nodes[root];
  switch (node.kind) {
  case NodeKind::Number:
  case NodeKind::Letter:
  case NodeKind::Indexed:
  case NodeKind::System: return std::string(program.text_of(node.span));
  case NodeKind::Group: return bracketed(program, root - 1);
  case NodeKind::Negate: return "[-" + bracketed(program, root - 1) + "]";
  case NodeKind::Binary:
    return "[" + bracketed(program, program.nodes[root - 1].first - 1) +
           spec::operators[node.what].symbol + bracketed(program, root - 1) + "]";
  case NodeKind::Call:
    return "[" + std::string(spec::functions[node.what].word) + " " + bracketed(program, root - 1) +
           "]";
  }
  return {};
}

std::string expression(const std::string& text) {
  const One one("10 A = " + text);
  if (one.statement.error)
    return "error";
  return bracketed(one.program, one.program.items[1].value);
}

TEST(Parse, AnyLineOfJoinedTextsMayBeginWithAByteOrderMark) {
  const auto program = parse("\xEF\xBB\xBF"
                             "10 print 1\n' b\n\xEF\xBB\xBF"
                             "20 end\n");
  EXPECT_EQ(format(program), "10 print 1\n' b\n20 end\n");
}

TEST(Parse, ByteOrderMarksAmongBlanksAreNoPartOfALine) {
  const auto program = parse(" \xEF\xBB\xBF \xEF\xBB\xBF\xEF\xBB\xBF 10 print 1\n \xEF\xBB\xBF");
  EXPECT_EQ(format(program), "10 print 1\n");
  EXPECT_EQ(program.lines[0].span.size(), 11U); // including the blank before it
}

TEST(Parse, PrecedenceHasTwoLevelsAndTakesEqualsFromTheLeft) {
  EXPECT_EQ(expression("1+2&3"), "[[1+2]&3]");
  EXPECT_EQ(expression("2|1*4"), "[2|[1*4]]");
  EXPECT_EQ(expression("6&3+1"), "[[6&3]+1]");
  EXPECT_EQ(expression("10-3-2"), "[[10-3]-2]");
  EXPECT_EQ(expression("2*3{1%5}2/7"), "[[[[[2*3]{1]%5]}2]/7]");
  EXPECT_EQ(expression("(2+3)*5"), "[[2+3]*5]");
}

TEST(Parse, AFunctionTakesTheWholeExpressionThatFollows) {
  EXPECT_EQ(expression("sqrt A+1"), "[sqrt [A+1]]");
  EXPECT_EQ(expression("2*sqrt A+1"), "[2*[sqrt [A+1]]]");
  EXPECT_EQ(expression("(sqrt A)+1"), "[[sqrt A]+1]");
  EXPECT_EQ(expression("rnd 10 + abs B * 2"), "[rnd [10+[abs [B*2]]]]");
}

TEST(Parse, AMinusSignMayStandBeforeAnOperand) {
  EXPECT_EQ(expression("-9"), "[-9]");
  EXPECT_EQ(expression("-A*2"), "[[-A]*2]");
  EXPECT_EQ(expression("5*-3"), "[5*[-3]]");
  EXPECT_EQ(expression("--3"), "error");
  EXPECT_EQ(expression("+3"), "error");
}

// words are read whole, and case matters.
TEST(Parse, KeywordsThatBeginAlikeAreToldApart) {
  EXPECT_EQ(kind_of("10 read A"), Statement::Read);
  EXPECT_EQ(kind_of("10 reset"), Statement::Reset);
  EXPECT_EQ(kind_of("10 return"), Statement::Return);
  EXPECT_EQ(kind_of("10 rstr"), Statement::Rstr);
  EXPECT_EQ(kind_of("10 raw 1,2,3,4"), Statement::Raw);
  EXPECT_EQ(kind_of("10 random"), Statement::Random);
  EXPECT_EQ(kind_of("10 RGB rnd 3,rnd 3,rnd 3"), Statement::Rgb);
  EXPECT_EQ(kind_of("10 on A goto 10"), Statement::On);
  EXPECT_EQ(kind_of("10 heading 1"), Statement::Heading);
  EXPECT_EQ(kind_of("10 goroll 0,0,0"), Statement::Goroll);
  EXPECT_EQ(kind_of("10 A = roll + speed + xpos"), Statement::Let);
  EXPECT_EQ(kind_of("10 if A = 1 or B = 2 then return"), Statement::If);
  EXPECT_EQ(error_of("10 randomize"), BasicError::UnknownStatement);
  EXPECT_EQ(error_of("10 nextX"), BasicError::UnknownStatement);
  EXPECT_EQ(error_of("10 ra 1,2,3,4"), BasicError::UnknownStatement);
}

TEST(Parse, EveryWordOfTheTablesIsFoundAndNoOther) {
  for (const auto& row : spec::statements) {
    const auto word = find_word(row.word);
    EXPECT_EQ(word.kind, WordKind::Statement) << row.word;
    EXPECT_EQ(static_cast<Statement>(word.index), row.statement) << row.word;
  }
  for (const auto& row : spec::functions)
    EXPECT_EQ(find_word(row.word).kind, WordKind::Function) << row.word;
  for (const auto& row : spec::variables)
    EXPECT_EQ(find_word(row.word).kind, WordKind::Variable) << row.word;
  for (const char* other : {"rgb", "RGBs", "backled", "accelones", "timerD", "e", "thens", ""})
    EXPECT_TRUE(find_word(other).kind == WordKind::Unknown ||
                find_word(other).kind == WordKind::Letter)
        << other;
}

TEST(Parse, AStatementThatBeginsWithAnUnknownWordIsUnknownAllElseIsSyntax) {
  EXPECT_EQ(error_of("10 rgb 1,2,3"), BasicError::UnknownStatement);
  EXPECT_EQ(error_of("10 REM hello"), BasicError::UnknownStatement);
  EXPECT_EQ(error_of("10 printA"), BasicError::UnknownStatement);
  EXPECT_EQ(error_of("10 speed = 3"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 sqrt 3"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 then 3"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 = 3"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 next"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 if A then end"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 if A<=5 then end"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 input A,5"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 random 5"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 RGB 1,2"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 RGB 1,2,3,4"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 print \"open"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 Z(3) = 1"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("10 print Z(3)"), BasicError::SyntaxError);
  EXPECT_EQ(error_of("hello"), BasicError::SyntaxError);
}

// blanks are needed only between letters.
TEST(Parse, BlanksMayBeMissingWhereNoLettersMeet) {
  EXPECT_EQ(kind_of("10print\"x\"5"), Statement::Print);
  EXPECT_EQ(kind_of("10 goto20"), Statement::Goto);
  EXPECT_EQ(kind_of("10 for X=1to5step2"), Statement::For);
  EXPECT_EQ(kind_of("10 if A=1and(B)=2then?3else?4"), Statement::If);
  EXPECT_EQ(kind_of("10 on(A)gosub10,20"), Statement::On);
  EXPECT_EQ(kind_of("\t 10\tRGB\t1 , 2 ,3"), Statement::Rgb);
}

TEST(Parse, LinesEndInLfCrOrCrlf) {
  const std::string text = "10 end\r20 end\r\n\n30 end";
  const auto program = parse(text);
  ASSERT_EQ(program.lines.size(), 4U);
  EXPECT_EQ(program.lines[0].number, 10U);
  EXPECT_EQ(program.lines[1].number, 20U);
  EXPECT_FALSE(program.lines[2].has_number());
  EXPECT_EQ(program.lines[3].number, 30U);
}

TEST(Parse, TheTextEndsAtTheFirstNul) {
  const std::string text("10 end\n\0garbage", 15);
  EXPECT_EQ(parse(text).lines.size(), 1U);
}

TEST(Parse, CommentsAreKeptOutsideOfStringsOnly) {
  const std::string text = "' alone\n10 print \"it's\" 'said\n20 'nothing\n30 rgb \"'\" 'bad";
  const auto program = parse(text);
  ASSERT_EQ(program.lines.size(), 4U);
  EXPECT_EQ(program.text_of(program.lines[0].comment), "' alone");
  EXPECT_EQ(program.text_of(program.lines[1].comment), "'said");
  EXPECT_TRUE(program.lines[2].has_number());
  EXPECT_FALSE(program.lines[2].has_statement());
  EXPECT_EQ(program.text_of(program.lines[3].comment), "'bad");
}

// only the branch that is taken can fault.
TEST(Parse, ABranchThatDoesNotParseIsAloneInItsFault) {
  const One one("10 if A = 1 then foo \"else\" 'x");
  EXPECT_FALSE(one.statement.error);
  EXPECT_EQ(one.program.statements[one.statement.then_branch].error, BasicError::UnknownStatement);
  EXPECT_EQ(one.statement.else_branch, none);

  const One two("10 if A = 1 then print ) else X = 5");
  EXPECT_EQ(two.program.statements[two.statement.then_branch].error, BasicError::SyntaxError);
  ASSERT_NE(two.statement.else_branch, none);
  EXPECT_EQ(two.program.statements[two.statement.else_branch].kind, Statement::Let);

  const One three("10 if A = 1 then X = 5 else print 1 else print 2");
  EXPECT_FALSE(three.program.statements[three.statement.then_branch].error);
  EXPECT_EQ(three.program.statements[three.statement.else_branch].error, BasicError::SyntaxError);

  const One four("10 if A = 1 then if B = 2 then X = 1 else X = 2");
  EXPECT_EQ(four.program.statements[four.statement.then_branch].error, BasicError::SyntaxError);
  EXPECT_FALSE(four.program.statements[four.statement.else_branch].error);

  const One five("10 if A = 1 then 60");
  EXPECT_EQ(five.program.statements[five.statement.then_branch].error, BasicError::SyntaxError);
}

TEST(Parse, AtMostOneFaultALineAndRecoveryOnTheNext) {
  const std::string text = "10 foo ) ( foo\n20 if A = 1 then foo else bar\n30 print\n40 bar\n";
  const auto program = parse(text);
  ASSERT_EQ(program.faults.size(), 3U);
  EXPECT_EQ(program.faults[0].line, 0U);
  EXPECT_EQ(program.faults[1].line, 1U);
  EXPECT_EQ(program.faults[2].line, 3U);
}

TEST(Parse, LiteralsWrapModuloTwoToThePowerOf32) {
  const One one("10 A = 4294967299");
  const auto& node = one.program.nodes.at(0);
  EXPECT_TRUE(node.overflow);
  EXPECT_EQ(node.value, 3);
  EXPECT_FALSE(One("10 A = 2147483647").program.nodes.at(0).overflow);
  EXPECT_TRUE(One("10 A = 2147483648").program.nodes.at(0).overflow);
  EXPECT_EQ(One("10 A = 99999999999999999999999999").program.nodes.at(0).overflow, true);
}

TEST(Parse, PrintPartsStandInTheOrderOfTheText) {
  const One one("10 print \"a\" A*2,$B;Z,;");
  std::vector<ItemKind> kinds;
  for (const auto& item : one.program.items_of(one.statement))
    kinds.push_back(item.kind);
  EXPECT_EQ(kinds, (std::vector{ItemKind::String, ItemKind::Expression, ItemKind::Comma,
                                ItemKind::Character, ItemKind::Semicolon, ItemKind::Expression,
                                ItemKind::Comma, ItemKind::Semicolon}));
}

TEST(Parse, NestingDoesNotExhaustTheStack) {
  for (const char* opener : {"(", "-(", "sqrt ", "abs ("}) {
    std::string text = "10 A = ";
    for (int i = 0; i < 100000; ++i)
      text += opener;
    EXPECT_EQ(error_of(text), BasicError::ExpressionTooComplex) << opener;
  }
  std::string chain = "10 A = 1";
  for (int i = 0; i < 100000; ++i)
    chain += "+1";
  EXPECT_FALSE(error_of(chain));
}

TEST(Parse, AnyByteGivesAProgram) {
  for (int first = 0; first < 256; ++first)
    for (int second = 0; second < 256; ++second) {
      const std::string text = {'1', ' ', static_cast<char>(first), static_cast<char>(second)};
      const auto program = parse(text);
      EXPECT_LE(program.lines.size(), 3U);
    }
}

} // namespace
} // namespace orb::compiler
