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
  /// The tests for a body.
  struct Tests {
    CodeLine of;
    std::uint32_t begin; ///< the label before them
    std::uint32_t body;
    std::uint32_t otherwise; ///< the label if no test holds
    std::vector<Case> cases;
  };

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
      add(tests.of, LineKind::Goto).label = tests.body; // falling through skips the tests
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

  Code& code_;
  std::vector<std::uint32_t> at_;
  std::map<std::uint32_t, std::vector<Tests>> tests_; ///< by the label of their body
  std::map<const CodeLine*, std::uint32_t> first_test_;
};

} // namespace

void write_switches(Code& code) {
  SwitchWriter(code).write_all();
}

} // namespace orb::structured
