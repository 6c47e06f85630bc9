#include "compiler/load.h"

#include "compiler/generate.h"
#include "compiler/text/parse_basic.h"

#include <optional>

namespace orb::compiler {
namespace {

/// True if an expression of the statement uses a word added later than `language`. A former name of
/// a variable was available before.
bool reads_newer(const Program& program, const StatementNode& statement,
                 spec::BasicVersion language) {
  for (auto n = statement.nodes_begin; n < statement.nodes_end; ++n) {
    const auto& node = program.nodes[n];
    if (node.kind != NodeKind::System)
      continue;
    const auto& row = spec::info(static_cast<spec::Variable>(node.what));
    if (row.since > language && program.text_of(node.span) != row.old_word)
      return true;
  }
  return false;
}

std::optional<spec::BasicError> error_of_age(const Program& program, const StatementNode& statement,
                                             spec::BasicVersion language) {
  const auto& row = spec::info(statement.kind);
  const bool newer = row.since > language;
  const bool grew = statement.kind == spec::Statement::Goroll; // before, it took two values
  if (newer && !grew)
    return spec::BasicError::UnknownStatement;
  if ((newer && program.items_of(statement).size() == row.parameters().size()) ||
      reads_newer(program, statement, language))
    return spec::BasicError::SyntaxError;
  return std::nullopt;
}

} // namespace

bytecode::Chunk load(std::string_view text, spec::BasicVersion language) {
  auto program = parse(text);
  for (auto& statement : program.statements)
    if (!statement.error)
      statement.error = error_of_age(program, statement, language);
  return generate(program);
}

} // namespace orb::compiler
