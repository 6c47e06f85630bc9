#include "base/text/suggest.h"
#include "base/text/text.h"
#include "structured/meaning/check_pass.h"

#include "base/fixes.h"
#include <algorithm>
#include <fmt/format.h>

namespace orb::structured {
namespace {

/// True for names such as `onCollision` and `on_shake`: event handlers in other languages.
bool is_called_by_events(std::string_view name) {
  constexpr std::string_view on = "on";
  return name.size() > on.size() && equal_words(name.substr(0, on.size()), on) &&
         (name[on.size()] == '_' || name[on.size()] != to_lower(name[on.size()]));
}

/// Checks names that nothing uses, and functions without a value.
class NamesPass : private CheckPass {
public:
  using CheckPass::CheckPass;

  void run() {
    check_unused();
    check_values();
  }

private:
  void check_unused() {
    const bool runs = main_file_runs();
    for (const auto& symbol : names_.symbols) {
      if (symbol.read)
        continue;
      if (symbol.kind == SymbolKind::Sub || symbol.kind == SymbolKind::Function)
        check_uncalled(symbol);
      else if (symbol.kind == SymbolKind::Variable)
        report_unused(symbol, texts::SetNeverRead);
      else if (symbol.kind == SymbolKind::Local)
        report_unused(symbol, texts::NeverRead);
      else if (symbol.kind == SymbolKind::Constant && runs && in_main_file(symbol.span))
        report_unused(symbol,
                      texts::NeverUsed); // unused names in an included file may serve other files
    }
  }

  /// Uncalled subs may be for later use, except event handlers of other languages, which nothing
  /// will call.
  void check_uncalled(const Symbol& symbol) {
    const auto name = program_.text_of(symbol.span);
    if (symbol.used || !main_file_runs() || !in_main_file(symbol.span) ||
        !is_called_by_events(name))
      return;
    constexpr std::string_view shake = "shake";
    const bool shakes =
        name.size() > shake.size() && equal_words(name.substr(name.size() - shake.size()), shake);
    report(rules::UnusedName, symbol.span, texts::NeverCalled(name),
           shakes ? texts::AskInLoop("dshake") : texts::AskEitherInLoop("speed", "accelone"));
  }

  void report_unused(const Symbol& symbol, const Row<Hole::Code>& unused) {
    const auto name = program_.name(symbol.name);
    std::vector<std::string_view> others; // variables that are read
    for (const auto& other : names_.symbols)
      if (other.kind == SymbolKind::Variable && other.read && other.name != symbol.name)
        others.push_back(program_.name(other.name));
    constexpr std::size_t clear = 3; // letters; shorter names that differ by one are distinct names
    const auto meant = symbol.kind == SymbolKind::Variable && name.size() >= clear
                           ? closest(name, others)
                           : std::nullopt;
    auto& d = report(rules::UnusedName, symbol.span, unused(name));
    if (!meant)
      return;
    const auto line = at(symbol.statement).span;
    d.help = texts::Write(fmt::format("{}{}{}", program_.text_of({line.begin, symbol.span.begin}),
                                      *meant, program_.text_of({symbol.span.end, line.end})));
    d.fix = single_fix(d.help, symbol.span, std::string(*meant), Safety::Unsafe);
  }

  bool in_main_file(Span span) const {
    return &program_.file_at(span.begin) == &program_.files.front();
  }

  /// True if the main file has more than declarations for others to include.
  bool main_file_runs() const {
    return std::any_of(program_.statements.begin(), program_.statements.end(),
                       [&](const Statement& one) {
                         return one.depth == 0 && !declares(one.kind) && one.kind != Kind::EndSub &&
                                one.kind != Kind::EndFunction && in_main_file(one.span);
                       });
  }

  void check_values() {
    for (std::uint32_t n = 1; n < names_.routines.size(); ++n) {
      const auto& symbol = names_.symbols[names_.routines[n].symbol];
      if (symbol.kind != SymbolKind::Function || !symbol.used || gives_value(program_, names_, n))
        continue;
      std::string_view value = "e"; // the last value it computes
      const auto& begin = at(names_.routines[n].statement);
      for (auto i = names_.routines[n].statement; i < begin.next && begin.next != none; ++i)
        if (at(i).kind == Kind::Assign)
          value = program_.text_of(item(at(i), 0).span);
      report(rules::NoValue, symbol.span, texts::NeverReturns(program_.name(symbol.name)),
             texts::AddBefore(fmt::format("return {}", value), "end function"));
    }
  }
};

} // namespace

void check_names(Program& program, const Names& names) {
  NamesPass(program, names).run();
}

} // namespace orb::structured
