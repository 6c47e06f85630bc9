// Checks of print, input and read.

#include "compiler/lint/values_pass.h"

namespace orb::compiler {

void ValuesPass::check_print(const StatementNode& statement) {
  std::uint64_t least = 0;
  std::uint64_t most = 0;
  const auto items = program_.items_of(statement);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& part = items[i];
    if (part.kind == ItemKind::String) {
      least += part.span.size() - 2;
      most += part.span.size() - 2;
    } else if (part.kind == ItemKind::Expression) {
      const auto digits = printed(range_of(part));
      least += digits.least;
      most += digits.most;
    } else if (part.kind == ItemKind::Semicolon) {
    } else {
      ++least;
      ++most;
    }
  }
  const auto limit = static_cast<std::uint64_t>(spec::value_of(spec::Limit::PrintBytes));
  if (least > limit)
    findings_.add(rules::PrintTooLong, statement.span, texts::OutputIsAtLeast(least, limit),
                  texts::PrintRestOnNextLine());
  else if (most > limit)
    findings_.add(rules::PrintMayBeTooLong, statement.span, texts::OutputCanReach(most, limit));
}

void ValuesPass::check_input(const StatementNode& statement) {
  const auto input = program_.as<InputView>(statement);
  check_indexed({&input.variable, 1});
  const auto& row = spec::info(statement.kind);
  if (input.milliseconds != nullptr)
    check_range(*input.milliseconds, row.word, row.parameters()[0]);
}

void ValuesPass::check_data(const StatementNode& statement) {
  if (data_.unread != nullptr && !conditional_) {
    auto& d = findings_.add(rules::DataReplaced, statement.word, texts::ReplacesData(),
                            texts::PutAllOnOneLine());
    add_note(d, data_.unread->span, texts::ValuesAreLost());
  }
  const auto count = static_cast<std::uint32_t>(program_.items_of(statement).size());
  data_.size = std::min(count, static_cast<std::uint32_t>(spec::value_of(spec::Limit::DataValues)));
  data_.left = conditional_ ? DataSet::unknown : data_.size;
  data_.unread = conditional_ ? nullptr : &statement;
}

void ValuesPass::check_read(const StatementNode& statement) {
  const auto variables = program_.items_of(statement);
  const auto count = static_cast<std::uint32_t>(variables.size());
  check_indexed(variables);
  data_.unread = nullptr;
  if (conditional_) {
    data_.left = DataSet::unknown;
  } else if (data_.left == DataSet::unknown) {
    if (!has_data())
      findings_.add(rules::ReadPastData, statement.span, texts::Without("read", "data"),
                    texts::AddDataAbove());
  } else if (count > data_.left) {
    findings_.add(rules::ReadPastData, statement.span,
                  data_.left == 1 ? texts::OneValueLeft(count)
                                  : texts::ValuesLeft(data_.left, count));
    data_.left = DataSet::unknown;
  } else {
    data_.left -= count;
  }
}

bool ValuesPass::has_data() {
  if (!has_data_)
    has_data_ = std::any_of(program_.statements.begin(), program_.statements.end(),
                            [](const StatementNode& statement) {
                              return statement.error || statement.kind == spec::Statement::Data;
                            });
  return *has_data_;
}

void ValuesPass::check_quotient(const Node& node, std::uint32_t index) {
  const auto& right = program_.nodes[index - 1];
  const auto& left = program_.nodes[right.first - 1];
  if (left.kind != NodeKind::Number || right.kind != NodeKind::Number || left.value == 0)
    return;
  const auto quotient = fmt::format("{} / {}", left.value, right.value);
  findings_.add(rules::ZeroQuotient, node.span, texts::QuotientIs(quotient, 0),
                texts::MultiplyFirst("x * " + quotient));
}

} // namespace orb::compiler
