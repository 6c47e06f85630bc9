#include "structured/meaning/symbols.h"

#include "base/fixes.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"
#include "structured/meaning/unknown_names.h"
#include "structured/text/link_blocks.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace orb::structured {
namespace {

Message kind_of(SymbolKind kind) {
  switch (kind) {
  case SymbolKind::Variable: return texts::AVariable();
  case SymbolKind::Local: return texts::ALocal();
  case SymbolKind::Parameter: return texts::AParameter();
  case SymbolKind::Constant: return texts::AConstant();
  case SymbolKind::Array: return texts::AnArray();
  case SymbolKind::Sub: return texts::ASub();
  case SymbolKind::Function: return texts::AFunction();
  }
  return {};
}

/// Finds what each name means. Large because each kind of declaration and each kind of use has its
/// own rules.
class Resolver {
public:
  explicit Resolver(Program& program) : program_(program), unknown_(program, names_) {}

  Names run() {
    names_.routines.emplace_back();
    names_.of_node.assign(program_.nodes.size(), none);
    names_.of_statement.assign(program_.statements.size(), none);
    names_.routine_of.assign(program_.statements.size(), 0);
    shared_.assign(program_.names.size(), none);
    own_.assign(program_.names.size(), none);
    declare_all();
    declare_variables();
    look_up_all();
    check_constants();
    return std::move(names_);
  }

private:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {}) {
    return program_.diagnostics.emplace_back(
        finding(rule, span, std::move(message), std::move(help)));
  }

  std::uint32_t add(Symbol symbol) {
    names_.symbols.push_back(symbol);
    return static_cast<std::uint32_t>(names_.symbols.size()) - 1;
  }

  // ---- declarations

  void declare_all() {
    std::uint32_t routine = 0;
    rank_.assign(program_.statements.size(), 0);
    std::uint32_t rank = 0;
    for (const auto i : program_.order) {
      rank_[i] = ++rank;
      const auto& statement = program_.statements[i];
      if (statement.kind == Kind::Sub || statement.kind == Kind::Function) {
        routine = static_cast<std::uint32_t>(names_.routines.size());
        names_.routine_of[i] = routine;
        declare_routine(i);
      } else {
        names_.routine_of[i] = routine;
      }
      if (statement.kind == Kind::Const)
        declare_constant(i);
      else if (statement.kind == Kind::Array)
        declare_array(i);
      else if (statement.kind == Kind::Local)
        declare_locals(i, routine);
      else if (statement.kind == Kind::Use)
        declare_macros(i);
      else if (statement.kind == Kind::EndSub || statement.kind == Kind::EndFunction)
        routine = 0;
    }
  }

  std::uint32_t declare(Symbol symbol) {
    const auto name = symbol.name;
    if (shared_[name] != none) {
      report_taken(symbol, shared_[name]);
      return none;
    }
    return shared_[name] = add(symbol);
  }

  void report_taken(const Symbol& symbol, std::uint32_t other) {
    taken_.push_back(symbol.name);
    const auto& first = names_.symbols[other];
    auto& d = report(rules::NameTaken, symbol.span,
                     texts::AlreadyA(program_.text_of(symbol.span), kind_of(first.kind)),
                     texts::ChooseAnother());
    d.notes.push_back({first.span, texts::DeclaredHere()});
  }

  /// The symbol that statement `i` declares by its name.
  Symbol named(SymbolKind kind, std::uint32_t i) const {
    Symbol symbol;
    symbol.kind = kind;
    symbol.name = program_.statements[i].name;
    symbol.statement = i;
    symbol.span = program_.statements[i].name_span;
    return symbol;
  }

  void declare_routine(std::uint32_t i) {
    const auto& statement = program_.statements[i];
    auto symbol = named(statement.kind == Kind::Sub ? SymbolKind::Sub : SymbolKind::Function, i);
    symbol.routine = static_cast<std::uint32_t>(names_.routines.size());
    Routine routine;
    routine.statement = i;
    routine.symbol = declare(symbol);
    if (routine.symbol == none)
      routine.symbol = add(symbol);
    routine.first_parameter = static_cast<std::uint32_t>(names_.symbols.size());
    for (const auto& item : program_.items_of(statement)) {
      Symbol parameter;
      parameter.kind = SymbolKind::Parameter;
      parameter.name = item.value;
      parameter.statement = i;
      parameter.span = item.span;
      parameter.routine = symbol.routine;
      add(parameter);
      ++routine.parameters;
    }
    names_.routines.push_back(std::move(routine));
  }

  void declare_constant(std::uint32_t i) {
    auto symbol = named(SymbolKind::Constant, i);
    if (const auto value = constant(program_.statements[i].items_begin)) {
      symbol.value = value->value;
      symbol.duration = value->duration;
    }
    declare(symbol);
  }

  void declare_array(std::uint32_t i) {
    const auto& statement = program_.statements[i];
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    auto symbol = named(SymbolKind::Array, i);
    symbol.base = names_.elements;
    const auto size = constant(statement.items_begin);
    if (size && (size->value < 1 || size->value > most - names_.elements)) {
      report(rules::ArraySize, program_.items[statement.items_begin].span,
             names_.elements == 0 ? texts::SizeFrom1(most, size->value)
                                  : texts::ElementsLeft(most - names_.elements, most, size->value));
    } else if (size) {
      symbol.value = size->value;
      names_.elements += size->value;
    }
    declare(symbol);
  }

  void declare_locals(std::uint32_t i, std::uint32_t routine) {
    if (routine == 0)
      return; // already reported as misplaced
    for (const auto& item : program_.items_of(program_.statements[i])) {
      Symbol local;
      local.kind = SymbolKind::Local;
      local.name = item.value;
      local.statement = i;
      local.span = item.span;
      local.routine = routine;
      names_.routines[routine].locals.push_back(add(local));
    }
  }

  void declare_macros(std::uint32_t i) {
    shared_.resize(program_.names.size(), none);
    own_.resize(program_.names.size(), none);
    for (const auto& macro : program_.macros) {
      if (macro.statement != i)
        continue;
      Symbol symbol;
      symbol.kind = SymbolKind::Constant;
      symbol.name = macro.name;
      symbol.statement = i;
      symbol.span = program_.items[program_.statements[i].items_begin].span;
      symbol.value = macro.id;
      symbol.read = true;
      if (shared_[macro.name] != none) {
        report(rules::NameTaken, symbol.span, texts::DuplicateMacro(program_.name(macro.name)));
        continue;
      }
      declare(symbol);
    }
  }

  /// The value of an Expression item that must be constant. Names in it are looked up among those
  /// known so far.
  std::optional<Constant> constant(std::uint32_t item) {
    const auto root = program_.items[item].value;
    for (auto n = program_.nodes[root].first; n <= root; ++n)
      if (program_.nodes[n].kind == NodeKind::Name) {
        const auto symbol = shared_[static_cast<std::uint32_t>(program_.nodes[n].value)];
        if (symbol != none && names_.symbols[symbol].kind == SymbolKind::Constant) {
          names_.of_node[n] = symbol;
          names_.symbols[symbol].read = true;
        }
      }
    auto value = evaluate(program_, names_, root);
    if (!value)
      inconstant_.push_back(item);
    return value;
  }

  /// Reports values that could not be computed although all of their names are now known.
  void check_constants() {
    for (const auto item : inconstant_) {
      const auto& part = program_.items[item];
      bool known = !program_.nodes[part.value].is_condition();
      for (auto n = program_.nodes[part.value].first; n <= part.value; ++n)
        known = known && (program_.nodes[n].kind != NodeKind::Name || names_.of_node[n] != none);
      if (known)
        report(rules::NotConstant, part.span, texts::NotConstant(), texts::UseLiterals());
    }
  }

  // ---- scopes

  void enter(std::uint32_t routine) {
    for (const auto symbol : scope_)
      own_[names_.symbols[symbol].name] = none;
    scope_.clear();
    if (routine == 0)
      return;
    const auto& entered = names_.routines[routine];
    for (std::uint32_t n = 0; n < entered.parameters; ++n)
      open_name(entered.first_parameter + n);
    for (const auto local : entered.locals)
      open_name(local);
  }

  void open_name(std::uint32_t index) {
    const auto& symbol = names_.symbols[index];
    if (own_[symbol.name] != none) {
      if (!scope_reported(index))
        report_taken(symbol, own_[symbol.name]);
      return;
    }
    const auto shared = shared_[symbol.name];
    if (shared != none && names_.symbols[shared].kind != SymbolKind::Variable &&
        !scope_reported(index))
      report_taken(symbol, shared);
    own_[symbol.name] = index;
    scope_.push_back(index);
  }

  /// Scopes are entered twice; report each name once.
  bool scope_reported(std::uint32_t index) {
    if (reported_.size() < names_.symbols.size())
      reported_.resize(names_.symbols.size(), false);
    const bool before = reported_[index];
    reported_[index] = true;
    return before;
  }

  template <typename Visit>
  void each_statement(Visit visit) {
    std::uint32_t routine = 0;
    enter(0);
    for (const auto i : program_.order) {
      if (names_.routine_of[i] != routine) {
        routine = names_.routine_of[i];
        enter(routine);
      }
      visit(i);
    }
    enter(0);
  }

  // ---- variables

  /// True if the statement assigns the Place after its word without reading it.
  static bool sets(const Statement& statement) {
    return statement.kind == Kind::Assign || statement.kind == Kind::For ||
           statement.kind == Kind::Robot;
  }

  void declare_variables() {
    each_statement([&](std::uint32_t i) {
      const auto& statement = program_.statements[i];
      if (!sets(statement))
        return;
      for (const auto& item : program_.items_of(statement)) {
        if (item.kind != ItemKind::Place || program_.nodes[item.value].kind != NodeKind::Name)
          continue;
        const auto name = static_cast<std::uint32_t>(program_.nodes[item.value].value);
        if (own_[name] != none || shared_[name] != none)
          continue;
        Symbol symbol;
        symbol.kind = SymbolKind::Variable;
        symbol.name = name;
        symbol.statement = i;
        symbol.span = item.span;
        shared_[name] = add(symbol);
      }
    });
  }

  // ---- uses

  void look_up_all() {
    each_statement([&](std::uint32_t i) {
      look_up(i);
      const auto& statement = program_.statements[i];
      if (statement.kind == Kind::Call)
        look_up_call(i);
    });
  }

  void look_up(std::uint32_t i) {
    const auto& statement = program_.statements[i];
    // `RGB orange` is a colour unless the program has a name `orange`.
    const bool colour = statement.kind == Kind::Robot && statement.robot == spec::Statement::Rgb &&
                        statement.items_end - statement.items_begin < 3;
    const bool only = statement.items_end - statement.items_begin == 1;
    for (const auto& item : program_.items_of(statement)) {
      if (!item.has_nodes())
        continue;
      const bool place = item.kind == ItemKind::Place;
      for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
        const auto kind = program_.nodes[n].kind;
        if (kind != NodeKind::Name && kind != NodeKind::Element && kind != NodeKind::Call)
          continue;
        if (names_.of_node[n] != none)
          continue; // of a constant: resolved at its declaration
        if (colour && kind == NodeKind::Name && symbol_of(n) == none &&
            find_colour(program_.text_of(program_.nodes[n].span)))
          continue;
        if (colour && only && kind == NodeKind::Name && n == item.value && symbol_of(n) == none)
          unknown_.report_colour(program_.nodes[n].span);
        else if (place && n == item.value)
          look_up_place(n, statement);
        else
          look_up_value(n, i);
      }
    }
  }

  std::uint32_t symbol_of(std::uint32_t node) const {
    const auto name = static_cast<std::uint32_t>(program_.nodes[node].value);
    return own_[name] != none ? own_[name] : shared_[name];
  }

  void look_up_place(std::uint32_t n, const Statement& statement) {
    const auto& node = program_.nodes[n];
    const auto index = symbol_of(n);
    const bool element = node.kind == NodeKind::Element;
    if (index == none) {
      if (statement.kind != Kind::Next) // its name is that of its loop, or wrong anyway
        unknown_.report(node, element);
      return;
    }
    auto& symbol = names_.symbols[index];
    names_.of_node[n] = index;
    const bool variable = symbol.kind == SymbolKind::Variable || symbol.kind == SymbolKind::Local ||
                          symbol.kind == SymbolKind::Parameter;
    if (element ? symbol.kind != SymbolKind::Array : !variable) {
      names_.of_node[n] = none;
      auto* d = report_wrong(node, symbol,
                             element                               ? texts::NoElements()
                             : symbol.kind == SymbolKind::Function ? texts::ReturnGivesValue()
                             : symbol.kind == SymbolKind::Array    ? texts::NeedsIndex()
                                                                   : texts::NotAssigned());
      if (d != nullptr && symbol.kind == SymbolKind::Constant)
        make_variable(symbol, *d);
      const bool routine = symbol.kind == SymbolKind::Function || symbol.kind == SymbolKind::Sub;
      if (d != nullptr && routine && statement.kind == Kind::Assign &&
          statement.operation == Statement::none_operation) {
        const auto value = program_.text_of(program_.items[statement.items_begin + 1].span);
        const auto line = symbol.kind == SymbolKind::Function
                              ? fmt::format("return {}", value)
                              : fmt::format("{}({})", program_.text_of(node.span), value);
        d->help = texts::Write(line);
        d->fix = single_fix(d->help, statement.span, line, Safety::Unsafe);
      }
    } else if (element && (statement.kind == Kind::For)) {
      report(rules::WrongUse, node.span, texts::LoopNoElement());
    }
    // A loop counts in its variable. For a value that changes when read, reading is the purpose.
    if (statement.kind == Kind::For ||
        (statement.kind == Kind::Assign && has_effects(program_, statement)))
      symbol.read = true;
  }

  void look_up_value(std::uint32_t n, std::uint32_t statement) {
    const auto& node = program_.nodes[n];
    const auto index = symbol_of(n);
    if (index == none) {
      unknown_.report(node, node.kind != NodeKind::Name);
      return;
    }
    auto& symbol = names_.symbols[index];
    symbol.read = true;
    names_.of_node[n] = index;
    const bool value = symbol.kind == SymbolKind::Variable || symbol.kind == SymbolKind::Local ||
                       symbol.kind == SymbolKind::Parameter || symbol.kind == SymbolKind::Constant;
    if (node.kind == NodeKind::Name && !value)
      wrong(n, symbol,
            symbol.kind == SymbolKind::Array      ? texts::NeedsIndex()
            : symbol.kind == SymbolKind::Function ? texts::CallNeedsParentheses()
                                                  : texts::SubGivesNoValue());
    else if (node.kind == NodeKind::Element && symbol.kind != SymbolKind::Array)
      wrong(n, symbol, texts::NoElements());
    else if (node.kind == NodeKind::Call && symbol.kind == SymbolKind::Sub &&
             gives_value(program_, names_, symbol.routine))
      names_.of_node[n] = none; // the error at the `return` says to make it a function
    else if (node.kind == NodeKind::Call && symbol.kind != SymbolKind::Function)
      wrong(n, symbol,
            symbol.kind == SymbolKind::Sub     ? texts::CallAsStatement()
            : symbol.kind == SymbolKind::Array ? texts::ElementInBrackets()
                                               : texts::NotCalled());
    else if (node.kind == NodeKind::Call)
      check_call(index, node.count, node.span);
    if (symbol.kind == SymbolKind::Constant && rank_[symbol.statement] > rank_[statement]) {
      names_.of_node[n] = none;
      report(rules::NotConstant, node.span, texts::DeclaredBelow(program_.name(symbol.name)),
             texts::MoveDeclaration());
    }
  }

  void wrong(std::uint32_t n, const Symbol& symbol, Message why) {
    names_.of_node[n] = none;
    report_wrong(program_.nodes[n], symbol, std::move(why));
  }

  /// Returns null if nothing is reported.
  Diagnostic* report_wrong(const Node& node, const Symbol& symbol, Message why) {
    if (std::find(taken_.begin(), taken_.end(), symbol.name) != taken_.end())
      return nullptr; // with two meanings, the other one may be intended
    auto& d =
        report(rules::WrongUse, node.span,
               texts::WrongKind(program_.name(symbol.name), kind_of(symbol.kind), std::move(why)));
    d.notes.push_back({symbol.span, texts::DeclaredHere()});
    return &d;
  }

  void check_call(std::uint32_t index, std::uint32_t count, Span span) {
    auto& symbol = names_.symbols[index];
    symbol.used = true;
    const auto& routine = names_.routines[symbol.routine];
    if (count == routine.parameters)
      return;
    const auto name = program_.name(symbol.name);
    auto& d = report(rules::ArgumentCount, span,
                     routine.parameters == 1
                         ? compiler::texts::TakesOneFound(name, count)
                         : compiler::texts::TakesFound(name, routine.parameters, count));
    const auto& header = program_.statements[routine.statement];
    if (routine.parameters == 0 && symbol.kind == SymbolKind::Sub) {
      d.help = texts::Write(name);
      d.fix = single_fix(d.help, span, std::string(name), Safety::Unsafe);
    }
    if (count < routine.parameters)
      d.help = texts::ArgumentMissing(
          program_.name(names_.symbols[routine.first_parameter + count].name),
          program_.text_of({header.name_span.begin, header.span.end}));
  }

  /// Offers to make a constant a variable, since it is assigned.
  void make_variable(const Symbol& symbol, Diagnostic& d) const {
    const auto& declared = program_.statements[symbol.statement];
    const Span word{declared.span.begin, declared.name_span.begin};
    d.help = texts::MakeVariable(program_.text_of({word.end, declared.span.end}));
    d.fix = single_fix(texts::ItAVariable(), word, "", Safety::Unsafe);
  }

  void look_up_call(std::uint32_t i) {
    const auto& statement = program_.statements[i];
    const auto index =
        own_[statement.name] != none ? own_[statement.name] : shared_[statement.name];
    if (index == none) {
      unknown_.report_word(statement.name_span);
      return;
    }
    const auto& symbol = names_.symbols[index];
    Node node;
    node.span = statement.name_span;
    if (symbol.kind == SymbolKind::Function) {
      auto* d = report_wrong(node, symbol, texts::ValueMustBeUsed());
      if (d != nullptr && !gives_value(program_, names_, symbol.routine))
        turn(program_, names_, symbol.routine, SymbolKind::Sub, *d);
    } else if (symbol.kind != SymbolKind::Sub) {
      report_wrong(node, symbol, texts::StatementStarts());
    } else {
      names_.of_statement[i] = index;
      check_call(index, statement.items_end - statement.items_begin, statement.span);
    }
  }

  Program& program_;
  Names names_;
  std::vector<std::uint32_t> shared_; ///< of each name: the global symbol, or none
  std::vector<std::uint32_t> own_;    ///< of each name: the local or parameter of this routine
  std::vector<std::uint32_t> scope_;  ///< the symbols in `own_`
  std::vector<std::uint32_t> taken_;  ///< names with two meanings
  std::vector<bool> reported_;
  std::vector<std::uint32_t> rank_;       ///< of each statement: its position in the order
  std::vector<std::uint32_t> inconstant_; ///< items not constant so far
  UnknownNames unknown_;
};

} // namespace

Names resolve(Program& program) {
  return Resolver(program).run();
}

} // namespace orb::structured
