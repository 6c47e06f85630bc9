#include "editor/languages/structured/structured_names.h"

#include "base/text/text.h"
#include "editor/text_places.h"
#include "structured/text/read.h"

#include <algorithm>
#include <utility>

namespace orb::editor {
namespace {

using structured::Compiled;
using structured::ItemKind;
using structured::Kind;
using structured::Names;
using structured::none;
using structured::Program;
using structured::SymbolKind;

class NameUses {
public:
  explicit NameUses(const Reading& reading) : program_(reading.program), names_(reading.names) {}

  std::vector<NameUse> collect() {
    for (std::uint32_t i = 0; i < program_.statements.size(); ++i)
      add_statement(i);
    std::sort(uses_.begin(), uses_.end(),
              [](const NameUse& a, const NameUse& b) { return a.span.begin < b.span.begin; });
    return std::move(uses_);
  }

private:
  void add(std::uint32_t symbol, Span span, bool is_set) {
    if (symbol == none)
      return;
    const auto& known = names_.symbols[symbol];
    const bool defines =
        known.kind == SymbolKind::Variable ? is_set : known.span.begin == span.begin;
    uses_.push_back({{symbol, none, none}, span, is_set, defines});
  }

  void add_label(const Meaning& meaning, const structured::Statement& statement) {
    const bool defines = statement.kind == Kind::Label;
    uses_.push_back({meaning, statement.name_span, defines, defines});
  }

  void add_statement(std::uint32_t i) {
    const auto& statement = program_.statements[i];
    const auto routine = names_.routine_of[i];
    if (statement.kind == Kind::Label || statement.kind == Kind::Goto)
      add_label({none, routine, statement.name}, statement);
    else if (statement.name != none) {
      const bool declares = statement.kind != Kind::Call;
      add(declares ? declared_by(i, statement.name) : names_.of_statement[i], statement.name_span,
          declares);
    }
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind == ItemKind::Name)
        add(declared_by(i, item.value), item.span, statement.kind != Kind::Robot);
      else if (item.kind == ItemKind::Expression || item.kind == ItemKind::Character ||
               item.kind == ItemKind::Place)
        add_nodes(item, statement.kind != Kind::Next);
    }
  }

  /// The symbol that a statement declares with a name, or that of the macro in `macrun`.
  std::uint32_t declared_by(std::uint32_t statement, std::uint32_t name) const {
    auto constant = none;
    for (std::uint32_t s = 0; s < names_.symbols.size(); ++s) {
      const auto& symbol = names_.symbols[s];
      if (symbol.name != name)
        continue;
      if (symbol.statement == statement)
        return s;
      if (symbol.kind == SymbolKind::Constant)
        constant = s;
    }
    return constant;
  }

  void add_nodes(const structured::Item& item, bool sets) {
    for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
      const auto& node = program_.nodes[n];
      if (names_.of_node[n] == none)
        continue;
      const auto length =
          static_cast<std::uint32_t>(program_.name(static_cast<std::uint32_t>(node.value)).size());
      add(names_.of_node[n], {node.span.begin, node.span.begin + length},
          sets && item.kind == ItemKind::Place && n == item.value);
    }
  }

  const Program& program_;
  const Names& names_;
  std::vector<NameUse> uses_;
};

} // namespace

std::optional<FarPlace> Reading::place(Span span) const {
  const auto at = structured::place_of(program, span);
  if (at.file >= sources.size() || at.span.size() != span.size())
    return std::nullopt;
  return FarPlace{sources[at.file], at.span, false};
}

Reading read_structured(const Source& source, const LanguageOptions& options) {
  structured::NoFiles no_files;
  Reading reading;
  reading.program = structured::read(source.name(), path_of_uri(source.name()), source.text(),
                                     options.files != nullptr ? *options.files : no_files);
  reading.names = structured::resolve(reading.program);
  for (const auto& file : reading.program.files)
    reading.sources.push_back(std::make_shared<const Source>(
        file.path, reading.program.text.substr(file.begin, file.end - file.begin)));
  return reading;
}

Compiled compile_structured(const Source& source, const LanguageOptions& options) {
  structured::NoFiles no_files;
  compiler::Target target;
  target.version = options.target;
  return structured::compile(source.name(), path_of_uri(source.name()), source.text(), target,
                             options.files != nullptr ? *options.files : no_files);
}

std::string comment_above(const Reading& reading, Span declared) {
  const auto place = reading.place(declared);
  if (!place)
    return {};
  const auto line = place->source->position(place->span.begin).line;
  const auto above = line > 1 ? trim(place->source->line(line - 1)) : std::string_view();
  return above.starts_with("'") ? std::string(trim(above.substr(1))) : std::string();
}

std::vector<NameUse> name_uses(const Reading& reading) {
  return NameUses(reading).collect();
}

} // namespace orb::editor
