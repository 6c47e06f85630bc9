#include "compiler/lint/lint_passes.h"

#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Statement;

constexpr auto letters = spec::letter_count;

/// What a statement shows until the next one of its kind.
enum class Shows : std::uint8_t { Nothing, Colour, Roll };

Shows shows(Statement kind) {
  if (kind == Statement::Rgb || kind == Statement::Ledc)
    return Shows::Colour;
  return kind == Statement::Goroll ? Shows::Roll : Shows::Nothing;
}

std::string_view name_of(Shows what) {
  return what == Shows::Colour ? "colour" : "roll";
}

/// Programs that run through and are still not what was meant: colours and rolls that nobody can
/// see, a ball that is left driving.
class IntentPass {
public:
  IntentPass(const Program& program, const Flow& flow, Findings& findings)
      : program_(program), flow_(flow), findings_(findings),
        size_(static_cast<std::uint32_t>(flow.code.size())) {}

  void run() {
    bool falls = true;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& code = flow_.code[i];
      if (code.target || !falls)
        forget();
      falls = code.falls;
      const auto& statement = program_.statements[code.statement];
      if (statement.then_branch != none)
        check_branches(statement);
      else
        check(statement, i);
    }
    if (falls && driving_ != nullptr)
      add_driving(program_.statements[flow_.code.back().statement].span);
    if (!headings_.empty() && grows_)
      check_growth();
  }

private:
  void forget() {
    forget_shown();
    driving_ = nullptr;
  }
  void forget_shown() {
    colour_ = nullptr;
    roll_ = nullptr;
  }

  void check(const StatementNode& statement, std::uint32_t code) {
    if (statement.error) {
      forget();
      return;
    }
    const auto after = spec::info(statement.kind).after;
    if (shows(statement.kind) != Shows::Nothing)
      check_shown(statement, code);
    else if (statement.kind == Statement::For)
      check_loop(code);
    else if (statement.kind == Statement::Next || after == spec::After::Waits)
      forget_shown();
    else if (statement.kind == Statement::End && driving_ != nullptr)
      add_driving(statement.span);
    else if (statement.kind == Statement::Let)
      grows_ = grows_ || is_sum(statement);
    else if (after != spec::After::Falls || is_foreign_hand(statement.kind))
      forget();
  }

  /// What else drives or colours the ball, or stops it.
  static bool is_foreign_hand(Statement kind) {
    return kind == Statement::Raw || kind == Statement::Macrun || kind == Statement::Mackill;
  }

  void check_shown(const StatementNode& statement, std::uint32_t code) {
    const auto what = shows(statement.kind);
    auto& last = what == Shows::Colour ? colour_ : roll_;
    if (last != nullptr) {
      auto& d = findings_.add(
          rules::MissingDelay, last->span,
          fmt::format("this {0} is never seen: another {0} follows at once", name_of(what)),
          "put a `delay 500` between them");
      add_note(d, statement.span, fmt::format("the next {}", name_of(what)));
    }
    last = &statement;
    if (what != Shows::Roll)
      return;
    driving_ = drives(statement) ? &statement : nullptr;
    const auto& heading = program_.nodes[program_.items_of(statement)[0].value];
    if (heading.kind == NodeKind::Letter)
      headings_.push_back({heading.what, code});
  }

  bool drives(const StatementNode& roll) const {
    const auto items = program_.items_of(roll);
    const auto is_on = [&](const Item& item) {
      const auto& root = program_.nodes[item.value];
      return root.kind == NodeKind::Number && root.value > 0;
    };
    return is_on(items[1]) && (items.size() < 3 || is_on(items[2]));
  }

  /// A branch may or may not run: what it touches is unknown after it, and a jump shows what was
  /// set before to whatever it leads to.
  void check_branches(const StatementNode& statement) {
    for (const auto& branch : program_.whole(statement).subspan(1)) {
      if (branch.error || spec::info(branch.kind).after != spec::After::Falls ||
          shows(branch.kind) != Shows::Nothing || is_foreign_hand(branch.kind))
        forget_shown();
      if (branch.error || shows(branch.kind) == Shows::Roll || is_foreign_hand(branch.kind) ||
          branch.kind == Statement::Gosub || branch.spelling == Spelling::OnGosub)
        driving_ = nullptr;
    }
  }

  /// A loop that shows something in each round and waits in none.
  void check_loop(std::uint32_t begin) {
    forget();
    const StatementNode* shown = nullptr;
    for (auto i = begin + 1; i < size_; ++i) {
      const auto& code = flow_.code[i];
      const auto& statement = program_.statements[code.statement];
      if (statement.error || code.target || statement.then_branch != none)
        return;
      if (statement.kind == Statement::Next)
        break;
      if (spec::info(statement.kind).after != spec::After::Falls || is_foreign_hand(statement.kind))
        return;
      if (shown == nullptr && shows(statement.kind) != Shows::Nothing)
        shown = &statement;
      if (i + 1 == size_)
        return;
    }
    if (shown != nullptr)
      findings_.add(rules::MissingDelay, shown->span,
                    fmt::format("only the last {} of the loop is seen: nothing waits in it",
                                name_of(shows(shown->kind))),
                    "put a `delay 50` below this line");
  }

  // ---- headings that grow

  bool is_sum(const StatementNode& let) const {
    const auto& root = program_.nodes[program_.as<LetView>(let).expression.value];
    return root.kind == NodeKind::Binary &&
           static_cast<spec::Operator>(root.what) == spec::Operator::Add;
  }

  struct Growth {
    std::uint32_t code = none;         ///< the line that adds to the letter; none where none does
    const Item* sum = nullptr;         ///< what it is set to there
    std::vector<std::uint32_t> resets; ///< lines that set it to a number
    bool bounded = false;              ///< it is looked at, or set in another way
  };
  struct Heading {
    std::uint32_t letter;
    std::uint32_t code;
  };

  /// Looks for endless loops that add to a heading and never look at it.
  void check_growth() {
    std::array<Growth, letters> growth;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto whole = program_.whole(program_.statements[flow_.code[i].statement]);
      for (const auto& statement : whole)
        if (!statement.error)
          read_growth(statement, i, whole.size() > 1, growth);
    }
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& statement = program_.statements[flow_.code[i].statement];
      if (statement.error || statement.kind != Statement::Goto)
        continue;
      const auto to = flow_.jumps[flow_.code[i].jumps_begin].to;
      const auto within = [&](std::uint32_t code) { return to <= code && code <= i; };
      for (const auto& heading : headings_) {
        auto& grown = growth[heading.letter];
        if (!within(heading.code) || !within(grown.code) || grown.bounded ||
            std::any_of(grown.resets.begin(), grown.resets.end(), within))
          continue;
        add_growth(*grown.sum, heading.letter);
        grown.bounded = true; // said once
      }
    }
  }

  void read_growth(const StatementNode& statement, std::uint32_t code, bool in_if,
                   std::array<Growth, letters>& growth) const {
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind == ItemKind::Letter)
        set_growth(statement, item.value, code, in_if, growth);
      if (in_if && item.kind == ItemKind::Expression)
        for (auto n = program_.nodes[item.value].first; n <= item.value; ++n)
          if (program_.nodes[n].kind == NodeKind::Letter)
            growth[program_.nodes[n].what].bounded = true;
    }
  }

  void set_growth(const StatementNode& statement, std::uint32_t letter, std::uint32_t code,
                  bool in_if, std::array<Growth, letters>& growth) const {
    auto& grown = growth[letter];
    if (statement.kind != Statement::Let || in_if) {
      grown.bounded = true;
      return;
    }
    const auto& sum = program_.as<LetView>(statement).expression;
    const auto& root = program_.nodes[sum.value];
    const auto& right = program_.nodes[sum.value - (root.kind == NodeKind::Number ? 0 : 1)];
    if (root.kind == NodeKind::Number) {
      grown.resets.push_back(code);
    } else if (root.kind == NodeKind::Binary && sum.value - root.first == 2 &&
               static_cast<spec::Operator>(root.what) == spec::Operator::Add &&
               program_.nodes[root.first].kind == NodeKind::Letter &&
               program_.nodes[root.first].what == letter && right.kind == NodeKind::Number &&
               right.value > 0 && grown.code == none) {
      grown.code = code;
      grown.sum = &sum;
    } else {
      grown.bounded = true;
    }
  }

  void add_growth(const Item& sum, std::uint32_t letter) {
    const auto text = program_.text_of(sum.span);
    const auto turn = spec::info(Statement::Goroll).parameters()[0].greatest + 1;
    auto& d = findings_.add(rules::HeadingGrows, sum.span,
                            fmt::format("`{}` is a heading and grows forever; headings end at {}",
                                        spec::letter_name(letter), turn - 1),
                            fmt::format("write `({}) % {}`", text, turn));
    d.fix = Fix{d.help,
                {{{sum.span.begin, sum.span.begin}, "("},
                 {{sum.span.end, sum.span.end}, fmt::format(") % {}", turn)}},
                Safety::Safe};
  }

  void add_driving(Span span) {
    auto& d = findings_.add(rules::DrivesOn, span, "the program ends while the ball drives",
                            "stop it first: `goroll 0,0,0`");
    add_note(d, driving_->span, "it has been driving since here");
    driving_ = nullptr;
  }

  const Program& program_;
  const Flow& flow_;
  Findings& findings_;
  std::uint32_t size_;
  std::vector<Heading> headings_;          ///< rolls whose heading is a letter
  bool grows_ = false;                     ///< something is set to a sum
  const StatementNode* colour_ = nullptr;  ///< set on this straight run, and not shown yet
  const StatementNode* roll_ = nullptr;    ///< the same of a roll
  const StatementNode* driving_ = nullptr; ///< the roll with which the ball drives for certain
};

} // namespace

void lint_intent(const Program& program, const Flow& flow, Findings& findings) {
  IntentPass(program, flow, findings).run();
}

} // namespace orb::compiler
