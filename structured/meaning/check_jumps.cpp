#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/idioms.h"
#include "structured/meaning/check_pass.h"

#include "base/fixes.h"
#include <algorithm>
#include <fmt/format.h>

namespace orb::structured {
namespace {

/// Checks jumps, labels and recursion.
class JumpsPass : private CheckPass {
public:
  using CheckPass::CheckPass;

  void run() {
    check_jumps();
    const auto& found = program_.diagnostics;
    if (std::none_of(found.begin(), found.end(), [](const Diagnostic& one) {
          return one.rule == &rules::UnclosedBlock || one.rule == &rules::BlockEnd;
        }))
      check_recursion(); // a sub without its end contains the calls below it
  }

private:
  void check_jumps() {
    std::vector<std::uint32_t> labels;
    for (const auto i : program_.order)
      if (at(i).kind == Kind::Label)
        labels.push_back(i);
    constexpr std::size_t most = 4096;
    if (labels.size() > most)
      labels.resize(most);
    for (std::size_t n = 0; n < labels.size(); ++n)
      for (std::size_t m = 0; m < n; ++m)
        if (at(labels[m]).name == at(labels[n]).name &&
            names_.routine_of[labels[m]] == names_.routine_of[labels[n]]) {
          report(rules::NameTaken, at(labels[n]).name_span,
                 texts::DuplicateLabel(program_.text_of(at(labels[n]).name_span)));
          break;
        }
    for (const auto i : program_.order)
      if (at(i).kind == Kind::Goto)
        check_goto(i, labels);
    for (const auto label : labels)
      check_label(label);
  }

  /// `sonst:` and `forever:` parse as labels but are foreign keywords.
  void check_label(std::uint32_t label) {
    const auto word = program_.text_of(at(label).name_span);
    const auto meant = repair::word_at(repair::tokens_of(word, repair::Language::Structured), 0);
    if (meant == "else" || meant == "forever")
      report(rules::ForeignWord, at(label).name_span, texts::NotOfThisLanguage(word));
  }

  void check_goto(std::uint32_t i, const std::vector<std::uint32_t>& labels) {
    const auto& jump = at(i);
    const auto label = std::find_if(labels.begin(), labels.end(), [&](std::uint32_t l) {
      return at(l).name == jump.name && names_.routine_of[l] == names_.routine_of[i];
    });
    if (label == labels.end()) {
      report_unknown_label(i, labels);
      return;
    }
    if (!encloses(*label, i))
      report(rules::GotoTarget, jump.name_span,
             texts::LabelInBlock(program_.text_of(jump.name_span)), texts::NotIntoBlocks());
    else
      report(rules::Unstructured, jump.span, texts::ProgramUses("goto"));
  }

  void report_unknown_label(std::uint32_t i, const std::vector<std::uint32_t>& labels) {
    const auto& jump = at(i);
    const auto word = std::string(program_.text_of(jump.name_span));
    auto& d = report(rules::GotoTarget, jump.name_span, texts::UnknownLabel(word));
    const auto sub =
        std::find_if(names_.symbols.begin(), names_.symbols.end(), [&](const Symbol& one) {
          return one.kind == SymbolKind::Sub && equal_words(program_.name(one.name), word);
        });
    if (sub != names_.symbols.end()) {
      const auto call =
          fmt::format("{}{}", word, names_.routines[sub->routine].parameters > 0 ? "(…)" : "");
      d.help = texts::ItIsASub(call);
      if (call == word)
        d.fix = single_fix(texts::CallSub(), jump.span, word, Safety::Unsafe);
      return;
    }
    std::vector<std::string_view> here;
    for (const auto label : labels)
      if (names_.routine_of[label] == names_.routine_of[i])
        here.push_back(program_.text_of(at(label).name_span));
    const auto meant = closest(word, here);
    if (!meant)
      return;
    d.help = texts::DidYouMean(*meant);
    d.fix = single_fix(texts::Write(*meant), jump.name_span, *meant, Safety::Unsafe);
  }

  /// True if every block around `label` is also around `other`.
  bool encloses(std::uint32_t label, std::uint32_t other) const {
    std::uint32_t depth = at(label).depth;
    for (auto n = label; depth > 0;) {
      if (n == 0)
        return false;
      --n;
      if (!opens_block(at(n).kind) || at(n).depth != depth - 1)
        continue;
      --depth;
      auto end = n;
      std::uint32_t part = n;
      while (at(end).next != none) {
        end = at(end).next;
        if (end <= label)
          part = end;
      }
      const auto part_end = at(part).next;
      if (other < part || part_end == none || other > part_end)
        return false;
    }
    return true;
  }

  void check_recursion() {
    const auto calls = calls_of(program_, names_);
    std::vector<std::uint8_t> state(calls.size(), 0); // 1: open, 2: done
    for (std::uint32_t root = 1; root < calls.size(); ++root) {
      std::vector<std::pair<std::uint32_t, std::size_t>> path;
      if (state[root] == 0) {
        path.push_back({root, 0});
        state[root] = 1;
      }
      while (!path.empty()) {
        auto& [routine, next] = path.back();
        if (next == calls[routine].size()) {
          state[routine] = 2;
          path.pop_back();
          continue;
        }
        const auto callee = calls[routine][next++];
        if (state[callee] == 1) {
          report_cycle(path, callee);
          return;
        }
        if (state[callee] == 0) {
          state[callee] = 1;
          path.push_back({callee, 0});
        }
      }
    }
  }

  void report_cycle(const std::vector<std::pair<std::uint32_t, std::size_t>>& path,
                    std::uint32_t callee) {
    const auto first = std::find_if(path.begin(), path.end(),
                                    [&](const auto& open) { return open.first == callee; });
    auto circle = texts::Quoted(name_of(callee));
    for (auto open = first + 1; open != path.end(); ++open)
      circle = texts::Calls(std::move(circle), name_of(open->first));
    const auto& symbol = names_.symbols[names_.routines[callee].symbol];
    report(rules::Recursion, symbol.span, texts::Calls(std::move(circle), name_of(callee)),
           texts::UseLoop());
  }

  std::string_view name_of(std::uint32_t routine) const {
    return program_.name(names_.symbols[names_.routines[routine].symbol].name);
  }
};

} // namespace

void check_jumps(Program& program, const Names& names) {
  JumpsPass(program, names).run();
}

} // namespace orb::structured
