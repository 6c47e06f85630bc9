#include "structured/lift/lifted_values.h"

#include "spec/limits.h"

#include <fmt/format.h>

namespace orb::structured::lifting {

const std::string& LiftedValues::letter_read(std::uint32_t which) {
  read_[which] = true;
  return names_.letter(which);
}
const std::string& LiftedValues::letter_set(std::uint32_t which) {
  set_[which] = true;
  return names_.letter(which);
}
std::string LiftedValues::element() {
  uses_elements_ = true;
  constexpr std::uint32_t index = 'Y' - 'A';
  return fmt::format("{}[{}]", names_.elements(), letter_read(index));
}

std::string LiftedValues::place(const compiler::Item& item) {
  if (item.kind == compiler::ItemKind::Letter)
    return letter_set(item.value);
  if (item.kind == compiler::ItemKind::Indexed)
    return element();
  return std::string(spec::variables[item.value].word);
}

/// Strips parentheses around the whole expression.
std::uint32_t LiftedValues::inner(std::uint32_t root) const {
  while (program_.nodes[root].kind == compiler::NodeKind::Group)
    --root;
  return root;
}

std::string LiftedValues::operand(std::uint32_t root) {
  const auto kind = program_.nodes[inner(root)].kind;
  const bool parts = kind == compiler::NodeKind::Binary || kind == compiler::NodeKind::Negate;
  const auto text = text_of(inner(root));
  return parts ? fmt::format("({})", text) : text;
}

std::string LiftedValues::text_of(std::uint32_t root) {
  const auto& node = program_.nodes[root];
  switch (node.kind) {
  case compiler::NodeKind::Number: return fmt::format("{}", node.value);
  case compiler::NodeKind::Letter: return letter_read(node.what);
  case compiler::NodeKind::Indexed: return element();
  case compiler::NodeKind::System: return std::string(program_.text_of(node.span));
  case compiler::NodeKind::Group: return operand(root);
  case compiler::NodeKind::Negate: return fmt::format("-{}", text_of(root - 1));
  case compiler::NodeKind::Binary: {
    const auto left = program_.nodes[root - 1].first - 1;
    auto text = text_of(left);
    text += fmt::format(" {} ", spec::operators[node.what].symbol);
    return text + text_of(root - 1);
  }
  case compiler::NodeKind::Call:
    return fmt::format("{}({})", spec::functions[node.what].word, text_of(inner(root - 1)));
  }
  return {};
}

std::string LiftedValues::declarations() const {
  std::string declared;
  if (uses_elements_)
    declared += fmt::format("array {}[{}]\n", names_.elements(),
                            spec::value_of(spec::Limit::IndexedVariables));
  for (std::size_t letter = 0; letter < read_.size(); ++letter)
    if (read_[letter] && !set_[letter])
      declared += fmt::format("{} = 0\n", names_.letter(letter));
  return declared;
}

} // namespace orb::structured::lifting
