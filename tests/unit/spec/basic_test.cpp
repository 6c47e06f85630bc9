#include "spec/basic.h"
#include "spec/limits.h"

#include <gtest/gtest.h>
#include <string>

namespace orb::spec {
namespace {

TEST(Basic, EveryWordIsFoundAgain) {
  for (const auto& row : statements)
    EXPECT_EQ(find_statement(row.word), row.statement) << row.word;
  for (const auto& row : functions)
    EXPECT_EQ(find_function(row.word), row.function) << row.word;
  for (const auto& row : variables)
    EXPECT_EQ(find_variable(row.word), row.variable) << row.word;
  for (const auto& row : basic_errors)
    EXPECT_EQ(find_error(code(row.error)), row.error) << row.text;
  EXPECT_EQ(find_variable("cmdval"), Variable::Cmdroll);
  EXPECT_EQ(find_statement("rgb"), std::nullopt);
  EXPECT_EQ(find_variable("Yaw"), std::nullopt);
  EXPECT_EQ(find_error(0), std::nullopt);
  EXPECT_EQ(find_error(15), std::nullopt);
}

TEST(Basic, RowsHoldWhatTheirConsumersNeed) {
  for (const auto& row : statements) {
    EXPECT_FALSE(row.summary.empty()) << row.word;
    EXPECT_FALSE(row.usage.empty()) << row.word;
    EXPECT_FALSE(row.source.empty()) << row.word;
    EXPECT_NE(row.example.find(row.word == "let" ? "=" : row.word), std::string_view::npos)
        << row.word;
    if (row.form == Form::Arguments) {
      EXPECT_LE(row.required, row.parameters().size()) << row.word;
    }
  }
  for (const auto& row : variables)
    EXPECT_LT(row.least, row.greatest) << row.word;
}

// The errors of the documents, with their numbers and words.
TEST(Basic, ErrorsAreNumberedAsTheRobotDoes) {
  EXPECT_EQ(basic_errors.size(), 14U);
  EXPECT_EQ(info(BasicError::SyntaxError).text, "Syntax error");
  EXPECT_EQ(code(BasicError::UnknownStatement), 2);
  EXPECT_EQ(code(BasicError::BadLineNumber), 9);
  EXPECT_EQ(info(BasicError::BadNumericParameter).text, "Bad numeric parameter");
  EXPECT_EQ(code(BasicError::OutOfData), 14);
}

TEST(Limits, AreThoseOfTheDocuments) {
  EXPECT_EQ(value_of(Limit::ForDepth), 4);
  EXPECT_EQ(value_of(Limit::GosubDepth), 4);
  EXPECT_EQ(value_of(Limit::ExpressionLevels), 4);
  EXPECT_EQ(value_of(Limit::PrintBytes), 32);
  EXPECT_EQ(value_of(Limit::DataValues), 25);
  EXPECT_EQ(value_of(Limit::GreatestLineNumber), 65535);
  for (const auto& row : limits) {
    EXPECT_FALSE(row.summary.empty()) << row.name;
    EXPECT_FALSE(row.source.empty()) << row.name;
  }
}

} // namespace
} // namespace orb::spec
