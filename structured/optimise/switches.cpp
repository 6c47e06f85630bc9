#include "structured/optimise/switches.h"

#include "structured/optimise/jumps.h"

#include <algorithm>
#include <map>
#include <utility>

namespace orb::structured {
namespace {

class SwitchWriter {
public:
  explicit SwitchWriter(Code& code) : code_(code) {}

  void join_all() {
    at_ = lines_of_labels(code_);
    for (auto& line : code_.lines)
      if (line.kind == LineKind::On)
        join_calls(line);
    land();
  }
  void write_all() {
    at_ = lines_of_labels(code_);
    const auto lines = std::exchange(code_.lines, {});
    for (std::uint32_t i = 0; i < lines.size(); ++i)
      if (lines[i].kind == LineKind::Switch)
        plan_tests(lines, i);
    for (const auto& line : lines) {
      if (line.kind == LineKind::Label)
        if (const auto tests = tests_.find(line.label); tests != tests_.end())
          write_tests(tests->second);
      if (line.kind != LineKind::Switch)
        code_.lines.push_back(line);
      else
        add(line, LineKind::Goto).label = first_test_[&line];
    }
  }

private:
  /// The tests that lead to a body.
  struct Tests {
    CodeLine of;
    std::uint32_t begin; ///< the label before them
    std::uint32_t body;
    std::uint32_t otherwise; ///< where they lead when none holds
    std::vector<Case> cases;
  };

  std::uint32_t after(std::uint32_t line) const {
    while (line < code_.lines.size() && (code_.lines[line].kind == LineKind::Label ||
                                         code_.lines[line].kind == LineKind::Nothing))
      ++line;
    return line;
  }

  /// `on e goto` to lines that each call a sub and go on at the same place.
  void join_calls(CodeLine& line) {
    std::uint32_t next = none;
    std::vector<Part> calls;
    for (auto n = line.parts_begin; n < line.parts_end; ++n) {
      const auto at = at_[code_.parts[n].value];
      const auto first = at == none ? code_.lines.size() : after(at);
      if (first + 1 >= code_.lines.size() || code_.lines[first].kind != LineKind::Gosub)
        return;
      const auto& jump = code_.lines[first + 1];
      const auto there =
          jump.kind == LineKind::Goto && at_[jump.label] != none ? after(at_[jump.label])
          : jump.kind == LineKind::Goto                          ? none
                                        : after(static_cast<std::uint32_t>(first) + 1);
      if (there == none || there >= code_.lines.size() || (next != none && next != there))
        return;
      next = there;
      Part part;
      part.kind = PartKind::Label;
      part.value = code_.lines[first].label;
      part.text.begin = code_.lines[first].variable; // the routine
      calls.push_back(part);
    }
    // The first target comes right after, so the way on is a jump from there.
    const auto index = static_cast<std::uint32_t>(&line - code_.lines.data());
    if (after(index + 1) >= code_.lines.size() ||
        code_.lines[after(index + 1)].kind != LineKind::Gosub)
      return;
    auto& first_call = code_.lines[after(index + 1)];
    first_call.kind = LineKind::Goto;
    first_call.label = code_.labels++;
    at_.push_back(next);
    landing_.push_back({next, first_call.label});
    line.kind = LineKind::OnGosub;
    line.parts_begin = static_cast<std::uint32_t>(code_.parts.size());
    code_.parts.insert(code_.parts.end(), calls.begin(), calls.end());
    line.parts_end = static_cast<std::uint32_t>(code_.parts.size());
  }

  void plan_tests(const std::vector<CodeLine>& lines, std::uint32_t i) {
    const auto& line = lines[i];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> bodies; // place and label
    for (auto n = line.parts_begin; n < line.parts_end; ++n)
      bodies.push_back({at_[code_.cases[n].label], code_.cases[n].label});
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    auto otherwise = line.label;
    for (auto body = bodies.rbegin(); body != bodies.rend(); ++body) {
      Tests tests{line, code_.labels++, body->second, otherwise, {}};
      for (auto n = line.parts_begin; n < line.parts_end; ++n)
        if (code_.cases[n].label == body->second)
          tests.cases.push_back(code_.cases[n]);
      otherwise = tests.begin;
      tests_[body->second].push_back(std::move(tests));
    }
    first_test_[&line] = otherwise;
  }

  CodeLine& add(const CodeLine& of, LineKind kind) {
    CodeLine line;
    line.kind = kind;
    line.origin = of.origin;
    line.routine = of.routine;
    line.expansion = of.expansion;
    code_.lines.push_back(line);
    return code_.lines.back();
  }

  void test(const CodeLine& of, Comparison comparison, std::int32_t value, std::uint32_t label) {
    Condition condition;
    const auto variable = code_.read(of.variable);
    condition.first = {comparison, variable, code_.number(value), {}, {}};
    code_.conditions.push_back(condition);
    auto& line = add(of, LineKind::If);
    line.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
    line.label = label;
  }

  void write_tests(const std::vector<Tests>& all) {
    for (const auto& tests : all) {
      add(tests.of, LineKind::Goto).label = tests.body; // what runs into the body passes the tests
      add(tests.of, LineKind::Label).label = tests.begin;
      for (std::size_t n = 0; n < tests.cases.size(); ++n) {
        const auto& one = tests.cases[n];
        const bool last = n + 1 == tests.cases.size();
        const auto skip = last ? tests.otherwise : code_.labels++;
        if (one.lo == one.hi) {
          if (last)
            test(tests.of, Comparison::NotEqual, one.lo, skip);
          else
            test(tests.of, Comparison::Equal, one.lo, tests.body);
        } else {
          test(tests.of, Comparison::Less, one.lo, skip);
          test(tests.of, last ? Comparison::Greater : Comparison::LessEqual, one.hi,
               last ? skip : tests.body);
        }
        if (!last)
          add(tests.of, LineKind::Label).label = skip;
      }
    }
  }

  /// Puts the labels after `on … gosub` where the program goes on.
  void land() {
    std::sort(landing_.begin(), landing_.end(), std::greater<>());
    for (const auto& [line, label] : landing_) {
      CodeLine here;
      here.kind = LineKind::Label;
      here.label = label;
      here.origin = code_.lines[line].origin;
      here.routine = code_.lines[line].routine;
      code_.lines.insert(code_.lines.begin() + line, here);
    }
    landing_.clear();
  }

  Code& code_;
  std::vector<std::uint32_t> at_;
  std::map<std::uint32_t, std::vector<Tests>> tests_; ///< by the label of their body
  std::map<const CodeLine*, std::uint32_t> first_test_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> landing_; ///< line and label before it
};

} // namespace

void write_switches(Code& code) {
  SwitchWriter(code).join_all();
  SwitchWriter(code).write_all();
}

} // namespace orb::structured
