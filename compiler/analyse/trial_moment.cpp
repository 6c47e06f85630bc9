#include "compiler/analyse/trial_moment.h"

#include "spec/limits.h"

#include <algorithm>

namespace orb::compiler {
namespace {

/// FNV-1a on 64-bit words.
class Mixer {
public:
  void add(std::uint64_t word) {
    constexpr std::uint64_t prime = 0x100000001b3; // of FNV-1a
    value_ = (value_ ^ word) * prime;
    value_ ^= value_ >> 32;
  }
  void add(const Range& range) {
    add(std::uint64_t{static_cast<std::uint32_t>(range.lo)} << 32 |
        static_cast<std::uint32_t>(range.hi));
  }
  void add(const Value& value) {
    add(value.range);
    add(static_cast<std::uint64_t>(value.exact) | static_cast<std::uint64_t>(value.dense) << 1 |
        static_cast<std::uint64_t>(value.ties) << 2 |
        static_cast<std::uint64_t>(value.origin) << 4);
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325; ///< the FNV-1a offset basis
};

} // namespace

std::uint64_t Moment::hash() const {
  Mixer all;
  all.add(std::uint64_t{at} << 32 | data);
  all.add(data_next);
  for (const auto& letter : letters)
    all.add(letter);
  for (const auto& element : elements)
    all.add(element);
  for (const auto& loop : loops) {
    all.add(std::uint64_t{loop.letter} << 32 | loop.body);
    all.add(loop.end);
  }
  for (const auto call : calls)
    all.add(call);
  return all.value();
}

Moment beginning(const Program& program) {
  std::size_t letters = 0;
  bool indexed = false;
  const auto use = [&](std::size_t letter) { letters = std::max(letters, letter + 1); };
  for (const auto& node : program.nodes) {
    if (node.kind == NodeKind::Letter)
      use(node.what);
    indexed = indexed || node.kind == NodeKind::Indexed;
  }
  for (const auto& item : program.items) {
    if (item.kind == ItemKind::Letter)
      use(item.value);
    indexed = indexed || item.kind == ItemKind::Indexed;
  }
  Moment moment;
  if (indexed) {
    use(index_letter);
    moment.elements.assign(spec::value_of(spec::Limit::IndexedVariables), Value::only(0));
  }
  moment.letters.assign(letters, Value::only(0));
  return moment;
}

void join_into(Moment& into, const Moment& from) {
  const auto join_all = [](std::vector<Value>& values, const std::vector<Value>& others) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(values[i] == others[i])) {
        values[i] = join(values[i], others[i]);
        values[i].ties = Ties::Shared;
      }
  };
  join_all(into.letters, from.letters);
  join_all(into.elements, from.elements);
  if (into.data != from.data || into.data_next != from.data_next)
    into.data = Moment::unknown_data;
}

} // namespace orb::compiler
