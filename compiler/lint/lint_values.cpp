// Follows the values of letters; values_checks.cpp judges them.

#include "compiler/lint/values_pass.h"

namespace orb::compiler {

void ValuesPass::collect_letters() {
  for (const auto kind :
       {spec::Statement::Let, spec::Statement::For, spec::Statement::Read, spec::Statement::Input})
    for (const auto& place : flow_.all(kind))
      collect_set(program_.statements[place.statement]);
  find_sensors();
  unknown_ = all_zero();
  for (std::uint32_t i = 0; i < program_.letters; ++i)
    if ((set_ & bit(i)) != 0)
      unknown_[i] = {};
}

void ValuesPass::find_sensors() {
  std::uint32_t used = program_.letters > spec::letter_count ? 0 : program_.letters;
  for (const auto& node : program_.nodes)
    if (node.kind == NodeKind::Letter)
      used = std::max(used, std::uint32_t{node.what} + 1);
  for (const auto& item : program_.items)
    if (item.kind == ItemKind::Letter && item.value + 1 < most_letters)
      used = std::max(used, item.value + 1);
  std::array<std::uint8_t, spec::variables.size()> tests{};
  after_sensors_ = first_sensor_ = used;
  for (const auto& place : flow_.all(spec::Statement::If)) {
    const auto sensor =
        sensor_in(program_, program_.as<IfView>(program_.statements[place.statement]).first.left);
    if (!sensor || spec::info(*sensor).access == spec::Access::ReadClears)
      continue;
    const auto n = static_cast<std::size_t>(*sensor);
    if (++tests[n] == 2 && after_sensors_ + 1 < most_letters)
      letter_of_sensor_[n] = static_cast<std::uint8_t>(after_sensors_++);
  }
}

void ValuesPass::forget_sensors() {
  std::fill(now_.begin() + first_sensor_, now_.begin() + after_sensors_, Value{});
}

LetterValues ValuesPass::at_start() const {
  auto letters = all_zero();
  std::fill(letters.begin() + first_sensor_, letters.begin() + after_sensors_, Value{});
  return letters;
}

void ValuesPass::collect_set(const StatementNode& statement) {
  for (const auto& item : program_.items_of(statement)) {
    if (item.kind != ItemKind::Letter)
      continue;
    set_ |= bit(item.value);
    auto& letter = letters_[item.value];
    if (letter.first_set == nullptr || &item < letter.first_set)
      letter.first_set = &item;
    (statement.kind == spec::Statement::For ? letter.counted : letter.assigned) = true;
  }
}

bool ValuesPass::clears(std::uint32_t letter) const {
  return std::any_of(program_.statements.begin(), program_.statements.end(),
                     [&](const auto& statement) {
                       if (statement.error || statement.kind != spec::Statement::Let)
                         return false;
                       const auto let = program_.as<LetView>(statement);
                       return let.variable.kind == ItemKind::Letter &&
                              let.variable.value == letter && reads_clearing(let.expression);
                     });
}

bool ValuesPass::reads_clearing(const Item& expression) const {
  for (auto n = program_.nodes[expression.value].first; n <= expression.value; ++n)
    if (program_.nodes[n].kind == NodeKind::System &&
        spec::variables[program_.nodes[n].what].access == spec::Access::ReadClears)
      return true;
  return false;
}

void ValuesPass::check_letters() {
  const bool silent = !program_.faults.empty(); // a line that does not parse may contain the rest
  for (std::uint32_t i = 0; i < program_.letters && !silent; ++i) {
    const auto& letter = letters_[i];
    const bool used = letter.first_used != nullptr;
    const bool set = letter.first_set != nullptr;
    if (set && !used && !letter.counted && !(i == index_letter && indexed_used_) && !clears(i)) {
      findings_.add(rules::UnusedVariable, letter.first_set->span,
                    texts::SetButNeverUsed(spec::letter_name(i)));
    } else if (used && !set) {
      auto& d = findings_.add(rules::NeverAssigned, letter.first_used->span,
                              texts::UsedButNeverSet(spec::letter_name(i)));
      if (const auto meant = meant_by(i); !meant.empty())
        d.fix = single_fix(texts::WriteValue(meant), d.span, meant, Safety::Unsafe);
    }
  }
}

/// The likely intent for a letter that is never assigned: a digit that looks like it, or the unused
/// variable of the enclosing loop; empty if neither applies.
std::string ValuesPass::meant_by(std::uint32_t letter) const {
  const auto& use = letters_[letter].first_used->span;
  const auto written = program_.text_of(use);
  if (written == "O" || written == "o")
    return "0";
  if (written == "l")
    return "1";
  const StatementNode* loop = nullptr;
  for (const auto& statement : program_.statements) {
    const bool counts = !statement.error && (statement.kind == spec::Statement::For ||
                                             statement.kind == spec::Statement::Next);
    if (!counts || program_.items_of(statement).front().kind != ItemKind::Letter)
      continue;
    if (statement.span.begin > use.begin)
      return loop != nullptr && statement.kind == spec::Statement::Next
                 ? std::string(program_.text_of(program_.items_of(*loop).front().span))
                 : "";
    const auto variable = program_.items_of(statement).front().value;
    loop = statement.kind == spec::Statement::For && statement.span.end <= use.begin &&
                   letters_[variable].first_used == nullptr
               ? &statement
               : nullptr;
  }
  return {};
}

void ValuesPass::forget_letters() {
  now_ = unknown_;
  if ((set_ & bit(index_letter)) != 0)
    index_begins_.reset();
}

void ValuesPass::set_letter(std::uint32_t index, const Value& value) {
  now_[index] = value;
  if (index == index_letter)
    index_begins_.reset();
}

void ValuesPass::follow() {
  following_ = true;
  find_data();
  ways_.enter(0, at_start());
  for (auto code = ways_.take(); code != none; code = ways_.take())
    follow(code);
  following_ = false;
  followed_ = true;
}

void ValuesPass::follow(std::uint32_t begin) {
  ways_.load(begin, now_);
  block_ = begin;
  for (auto i = begin; i < flow_.code.size(); ++i) {
    if (i > begin && ways_.is_kept(i)) {
      ways_.enter(i, now_);
      return;
    }
    if (!go(program_.statements[flow_.code[i].statement], i))
      return;
  }
}

void ValuesPass::find_data() {
  bool any = false;
  forget_letters();
  for (const auto& statement : program_.statements) {
    if (statement.error || statement.kind != spec::Statement::Data)
      continue;
    for (const auto& item : program_.items_of(statement)) {
      const auto range = compute(item);
      data_range_ = any ? join(data_range_, range) : range;
      any = true;
    }
  }
}

bool ValuesPass::go(const StatementNode& statement, std::uint32_t code) {
  if (statement.error) {
    forget_letters(); // it may do anything, once corrected
    return true;
  }
  const auto& row = spec::info(statement.kind);
  if (row.form != spec::Form::Loop) // which assigns its letter before it computes its end
    compute(statement.nodes_begin, statement.nodes_end);
  if (row.after == spec::After::Waits)
    cleared_ = cleared_above_ = 0;
  const bool looks = !following_;
  switch (row.form) {
  case spec::Form::Assignment: set(program_.as<LetView>(statement)); return true;
  case spec::Form::Loop: begin_loop(program_.as<ForView>(statement), code); return true;
  case spec::Form::LoopEnd: return end_loop(program_.as<NextView>(statement), code);
  case spec::Form::Branch: return jump(statement, code);
  case spec::Form::IndexedBranch:
    if (looks)
      check_on(program_.as<OnView>(statement));
    return jump(statement, code);
  case spec::Form::Conditional:
    if (looks) {
      const auto condition = program_.as<IfView>(statement);
      check_condition(condition);
      // A loop may depend on it.
      at_risk_ = at_risk_ || (letter_in(program_, condition.first.left) &&
                              flow_.code[code].jumps_begin < flow_.code[code].jumps_end);
    }
    return go_branches(statement, code);
  case spec::Form::Output:
    if (looks)
      check_print(statement);
    return true;
  case spec::Form::Entry:
    if (looks)
      check_input(statement);
    forget(program_.items_of(statement).first(1));
    return true;
  case spec::Form::Values:
    if (looks)
      check_data(statement);
    return true;
  case spec::Form::Variables:
    if (looks)
      check_read(statement);
    read(program_.items_of(statement));
    return true;
  case spec::Form::Arguments:
    if (looks)
      check_arguments(statement);
    else if (statement.kind == spec::Statement::Return)
      ways_.leave(code, now_);
    else if (statement.kind == spec::Statement::Reset)
      ways_.enter(0, at_start());
    if (statement.kind != spec::Statement::Rgb && statement.kind != spec::Statement::Ledc)
      forget_sensors();
    return row.after != spec::After::Ends;
  }
  return true;
}

bool ValuesPass::go_branches(const StatementNode& statement, std::uint32_t code) {
  const auto before = now_;
  const auto condition = program_.as<IfView>(statement);
  const auto* otherwise =
      statement.else_branch == none ? nullptr : &program_.statements[statement.else_branch];
  conditional_ = true;
  const auto cleared = cleared_on_line_;
  const bool then_falls =
      go_branch(condition, Holds::Yes, &program_.statements[statement.then_branch], code);
  auto after = now_;
  now_ = before;
  cleared_on_line_ = cleared;
  const bool else_falls = go_branch(condition, Holds::No, otherwise, code);
  conditional_ = false;
  if (then_falls && else_falls) {
    join_into(now_, after);
    // A letter that is tested and kept on both paths is probably handled by the other statement.
    for (std::uint32_t i = 0; i < program_.letters; ++i)
      now_[i].exact = now_[i].exact && (tested_ & bit(i)) == 0;
  } else if (then_falls) {
    now_ = after;
  }
  tested_ = 0;
  return then_falls || else_falls;
}

bool ValuesPass::go_branch(const IfView& condition, Holds holds, const StatementNode* branch,
                           std::uint32_t code) {
  const bool can_be = assume(condition, holds);
  if (branch == nullptr)
    return can_be;
  if (!can_be && !branch->error) {
    if (!following_)
      note_uses(*branch);
    return false;
  }
  const bool falls = go(*branch, code);
  if (branch->error)
    return true;
  if (branch->kind == spec::Statement::Let)
    tested_ &= ~bit(program_.as<LetView>(*branch).variable.value);
  return falls && can_be;
}

bool ValuesPass::assume(const IfView& condition, Holds holds) {
  if (condition.joint == nullptr)
    return assume(condition.first, holds);
  if ((condition.joint->kind == ItemKind::And) != (holds == Holds::Yes))
    return true; // either of the two
  return assume(condition.first, holds) && assume(*condition.second, holds);
}

bool ValuesPass::assume(const Comparison& comparison, Holds holds) {
  const auto orders = orders_of(comparison, holds);
  const auto left = known_[comparison.left.value].range;
  const auto right = known_[comparison.right.value].range;
  const auto left_where = where(orders, left, right);
  if (!left_where)
    return false;
  narrow(comparison.left, left, *left_where);
  if (program_.nodes[comparison.right.value].kind != NodeKind::Number) // a number never changes
    narrow(comparison.right, right, *where(mirrored(orders), right, left));
  return true;
}

void ValuesPass::narrow(const Item& side, const Range& from, const Range& to) {
  const auto letter = letter_in(program_, side);
  if (const auto sensor = sensor_in(program_, side))
    if (const auto own = letter_of_sensor_[static_cast<std::size_t>(*sensor)]; own != 0)
      now_[own] = {to, false, false, Origin::World, true, true};
  if (!letter || now_[*letter].range != from || from == to)
    return;
  tested_ |= bit(*letter);
  const bool dense = now_[*letter].dense;
  set_letter(*letter, {to, dense, dense, Origin::Program, true, true});
}

void ValuesPass::set(const LetView& let) {
  if (let.variable.kind != ItemKind::Letter) {
    if (!following_)
      check_let(let);
    return;
  }
  auto value = known_[let.expression.value];
  value.narrowed = value.bounded = value.fresh = false; // from here on, a value as any other
  set_letter(let.variable.value, value);
}

Range ValuesPass::rounds(const ForView& loop, const Range& start, const Range& end,
                         const Range& step) const {
  if (step.lo <= 0 && step.hi >= 0)
    return {};
  const bool up = step.lo > 0;
  if (start.constant() && end.constant() && step.constant() &&
      (up ? start.lo <= end.lo : start.lo >= end.lo) && !letters_[loop.variable.value].assigned) {
    const auto last = (std::int64_t{end.lo} - start.lo) / step.lo * step.lo + start.lo;
    return join(start, Range::only(static_cast<std::int32_t>(last)));
  }
  return up ? Range{start.lo, std::max(start.hi, end.hi)}
            : Range{std::min(start.lo, end.lo), start.hi};
}

void ValuesPass::begin_loop(const ForView& loop, std::uint32_t code) {
  const bool counts = loop.variable.kind == ItemKind::Letter;
  const auto start = compute(loop.start);
  if (counts)
    set_letter(loop.variable.value, {start});
  const auto end = compute(loop.end);
  const auto step = loop.step != nullptr ? compute(*loop.step) : Range::only(1);
  if (!following_)
    check_for(loop);
  if (!counts)
    return;
  const auto body = rounds(loop, start, end, step);
  set_letter(loop.variable.value, {body});
  if (loop.variable.value == index_letter && start.constant())
    index_begins_ = start.lo;
  if (!following_)
    return;
  const auto at =
      std::find_if(loops_.begin(), loops_.end(), [&](const Loop& one) { return one.code == code; });
  if (at == loops_.end())
    loops_.push_back({code, loop.variable.value, end, step, body});
  else
    *at = {code, at->letter, join(at->end, end), join(at->step, step), join(at->body, body)};
}

bool ValuesPass::end_loop(const NextView& next, std::uint32_t code) {
  if (!following_)
    check_indexed({&next.variable, 1});
  if (next.variable.kind != ItemKind::Letter)
    return true;
  const auto letter = next.variable.value;
  if (!followed_or_following()) {
    set_letter(letter, {});
    return true;
  }
  const auto before = now_;
  std::optional<Range> past;
  const auto nearest = loop_above(letter, code);
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    if (loops_[i].letter != letter || (nearest != none && loops_[i].code != nearest))
      continue;
    if (const auto left = next_of(loops_[i], before))
      past = past ? join(*past, *left) : *left;
  }
  now_ = before;
  if (!past)
    return false;
  set_letter(letter, {*past});
  return true;
}

std::uint32_t ValuesPass::loop_above(std::uint32_t letter, std::uint32_t code) const {
  auto nearest = none;
  for (const auto& loop : loops_)
    if (loop.letter == letter && loop.code < code && (nearest == none || loop.code > nearest))
      nearest = loop.code;
  return nearest;
}

std::optional<Range> ValuesPass::next_of(const Loop& loop, const LetterValues& before) {
  const auto stepped = apply(spec::Operator::Add, before[loop.letter].range, loop.step);
  const bool fixed = loop.step.lo > 0 || loop.step.hi < 0;
  const auto over = loop.step.lo > 0 ? Orders::Greater : Orders::Less;
  const auto within = fixed ? where(opposite(over), stepped, loop.end) : stepped;
  if (within && following_) {
    now_ = before;
    set_letter(loop.letter, {letters_[loop.letter].assigned ? *within : loop.body});
    ways_.enter(loop.code + 1, now_);
  }
  return fixed ? where(over, stepped, loop.end) : stepped;
}

void ValuesPass::read(std::span<const Item> variables) {
  for (const auto& variable : variables)
    if (variable.kind == ItemKind::Letter)
      set_letter(variable.value, {data_range_});
}

bool ValuesPass::jump(const StatementNode& statement, std::uint32_t code) {
  const bool calls =
      statement.kind == spec::Statement::Gosub || statement.spelling == Spelling::OnGosub;
  if (!following_ && !calls)
    return false;
  if (!followed_or_following()) {
    forget_letters();
    return true;
  }
  const auto before = now_;
  std::optional<LetterValues> after;
  for (const auto& way : flow_.jumps_of(flow_.code[code])) {
    if (way.item < statement.items_begin || way.item >= statement.items_end || way.to == none)
      continue;
    if (!way.call) {
      ways_.enter(way.to, before);
      continue;
    }
    now_ = before;
    if (!ways_.call(way.to, block_, now_))
      continue;
    if (after)
      join_into(*after, now_);
    else
      after = now_;
  }
  now_ = before;
  if (!calls)
    return false;
  if (after)
    now_ = *after;
  else if (!following_)
    forget_letters();
  forget_sensors();
  return after.has_value() || !following_;
}

void ValuesPass::begin_block() {
  cleared_ = 0;
  data_ = {};
  counting_ = 0;
  index_begins_.reset();
}

bool ValuesPass::run(Jumps jumps) {
  collect_letters();
  if (jumps == Jumps::Known && ways_.prepare(after_sensors_))
    follow();
  check_lines();
  check_letters();
  return at_risk_ || !flow_.all(spec::Statement::Read).empty();
}

bool lint_values(const Program& program, const Flow& flow, const Target& target, Jumps jumps,
                 Findings& findings) {
  const auto run = [&](const UsualValues* usual, Findings& found) {
    return ValuesPass(program, flow, target, usual, found).run(jumps);
  };
  const bool at_risk = run(nullptr, findings);
  const auto usual = usual_values(program, flow);
  if (jumps == Jumps::Unknown || usual == UsualValues{})
    return at_risk;
  Findings more;
  run(&usual, more);
  const auto& all = findings.all();
  for (auto& one : more.all())
    if (one.rule == &rules::MayLeaveRange &&
        std::none_of(all.begin(), all.end(), [&](const Diagnostic& d) {
          return d.severity != Severity::Info && meets(d.span, one.span);
        }))
      findings.add(std::move(one));
  return at_risk;
}

} // namespace orb::compiler
