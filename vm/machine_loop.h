// The loop that runs orbBasic: one block per instruction of bytecode/op.def. Included once by
// machine_threaded.cpp and once by machine_switch.cpp, inside a function that has a Core& core;
// they define
//   OP(name)    begins the block of an instruction
//   DISPATCH()  goes to the block of `pc`
//
// A line ends with NEXT_LINE: one count down, one compare. Everything that can happen besides
// (other parts of the ball, the end of `--for`, tracing) is behind that budget.

const Code* pc = core.pc;
Loop* loop = core.loop;
std::int64_t budget = core.budget;
std::int32_t* const r = core.registers.data();
const std::int64_t* const reciprocal = core.reciprocals.data();

#define NEXT_LINE()                                                                                \
  do {                                                                                             \
    if (--budget < 0)                                                                              \
      goto out_of_budget;                                                                          \
    DISPATCH();                                                                                    \
  } while (false)

#define FAULT(what)                                                                                \
  do {                                                                                             \
    core.error = what;                                                                             \
    goto fault;                                                                                    \
  } while (false)

// What the slow operations need to know.
#define SYNC()                                                                                     \
  core.at = pc;                                                                                    \
  core.pc = pc + 1;                                                                                \
  core.loop = loop;                                                                                \
  core.budget = budget

#define SLOW(call, go_on)                                                                          \
  do {                                                                                             \
    SYNC();                                                                                        \
    const Flow flow = call;                                                                        \
    if (flow == Flow::Next) {                                                                      \
      ++pc;                                                                                        \
      go_on();                                                                                     \
    }                                                                                              \
    return flow == Flow::Fault ? Exit::Fault : Exit::Leave;                                        \
  } while (false)

#define CALCULATE(op, x, y, divisor, out)                                                          \
  do {                                                                                             \
    if (const auto what = calculate<Arithmetic::op>(x, y, reciprocal + (divisor), out);            \
        failed(what))                                                                              \
      FAULT(what);                                                                                 \
  } while (false)

// The element of Z that `y` names.
#define ELEMENT(index, y)                                                                          \
  if (static_cast<std::uint32_t>(y) - 1u >= element_count)                                         \
    FAULT(BasicError::IllegalIndex);                                                               \
  const std::size_t index = first_element + static_cast<std::size_t>(y) - 1

NEXT_LINE();

#ifdef ORB_SWITCH
dispatch : switch (static_cast<Op>(reinterpret_cast<std::uintptr_t>(pc->handler))) {
#endif

// The following line, a `next` of the loop variable `name`, within the same block.
#define AND_NEXT(name)                                                                             \
  do {                                                                                             \
    const std::size_t counter = name;                                                              \
    ++pc;                                                                                          \
    if (--budget < 0)                                                                              \
      goto out_of_budget;                                                                          \
    NEXT_OF(counter);                                                                              \
  } while (false)

#define NEXT_OF(counter)                                                                           \
  if (loop->variable != counter)                                                                   \
    FAULT(BasicError::NextWithoutFor);                                                             \
  const std::int32_t value = bytecode::add(r[counter], loop->step);                                \
  r[counter] = value;                                                                              \
  if (loop->step > 0 ? value <= loop->end : value >= loop->end) {                                  \
    pc = loop->body;                                                                               \
    NEXT_LINE();                                                                                   \
  }                                                                                                \
  --loop;                                                                                          \
  ++pc;                                                                                            \
  NEXT_LINE()

  // --- values -----------------------------------------------------------------------------------
#define ORB_CALC(op, sign)                                                                         \
  OP(op) {                                                                                         \
    CALCULATE(op, r[pc->b], r[pc->c], pc->c, r[pc->a]);                                            \
    ++pc;                                                                                          \
    DISPATCH();                                                                                    \
  }                                                                                                \
  OP(op##Line) {                                                                                   \
    CALCULATE(op, r[pc->b], r[pc->c], pc->c, r[pc->a]);                                            \
    ++pc;                                                                                          \
    NEXT_LINE();                                                                                   \
  }                                                                                                \
  OP(op##Next) {                                                                                   \
    CALCULATE(op, r[pc->b], r[pc->c], pc->c, r[pc->a]);                                            \
    AND_NEXT(pc->e());                                                                             \
  }

#define CHAIN_LEFT(op1, op2)                                                                       \
  std::int32_t inner;                                                                              \
  CALCULATE(op1, r[pc->b], r[pc->c], pc->c, inner);                                                \
  CALCULATE(op2, inner, r[pc->d], pc->d, r[pc->a])

#define ORB_LEFT(op1, s1, op2, s2)                                                                 \
  OP(op1##Then##op2) {                                                                             \
    CHAIN_LEFT(op1, op2);                                                                          \
    ++pc;                                                                                          \
    DISPATCH();                                                                                    \
  }                                                                                                \
  OP(op1##Then##op2##Line) {                                                                       \
    CHAIN_LEFT(op1, op2);                                                                          \
    ++pc;                                                                                          \
    NEXT_LINE();                                                                                   \
  }                                                                                                \
  OP(op1##Then##op2##Next) {                                                                       \
    CHAIN_LEFT(op1, op2);                                                                          \
    AND_NEXT(pc->e());                                                                             \
  }

#define CHAIN_RIGHT(op1, op2)                                                                      \
  std::int32_t inner;                                                                              \
  CALCULATE(op2, r[pc->c], r[pc->d], pc->d, inner);                                                \
  CALCULATE(op1, r[pc->b], inner, 0, r[pc->a])

#define ORB_RIGHT(op1, s1, op2, s2)                                                                \
  OP(op1##Of##op2) {                                                                               \
    CHAIN_RIGHT(op1, op2);                                                                         \
    ++pc;                                                                                          \
    DISPATCH();                                                                                    \
  }                                                                                                \
  OP(op1##Of##op2##Line) {                                                                         \
    CHAIN_RIGHT(op1, op2);                                                                         \
    ++pc;                                                                                          \
    NEXT_LINE();                                                                                   \
  }                                                                                                \
  OP(op1##Of##op2##Next) {                                                                         \
    CHAIN_RIGHT(op1, op2);                                                                         \
    AND_NEXT(pc->e());                                                                             \
  }

  // --- decisions --------------------------------------------------------------------------------
#define TEST_IF(condition)                                                                         \
  if (condition) {                                                                                 \
    ++pc;                                                                                          \
    DISPATCH();                                                                                    \
  }                                                                                                \
  pc = pc->target();                                                                               \
  NEXT_LINE()

#define TEST_UNLESS(condition)                                                                     \
  if (condition)                                                                                   \
    ++pc;                                                                                          \
  else                                                                                             \
    pc = pc->target();                                                                             \
  DISPATCH()

#define TEST_GOTO(condition)                                                                       \
  if (condition) {                                                                                 \
    pc = pc->target();                                                                             \
    NEXT_LINE();                                                                                   \
  }                                                                                                \
  ++pc;                                                                                            \
  NEXT_LINE()

// Both values are read before the condition is known.
#define SELECT(pair, condition)                                                                    \
  const std::int32_t where_true = r[pair];                                                         \
  const std::int32_t where_false = r[(pair) + 1u];                                                 \
  r[pc->a] = (condition) ? where_true : where_false;                                               \
  ++pc;                                                                                            \
  NEXT_LINE()

#define SIMPLE(rel) holds<Relation::rel>(r[pc->a], r[pc->b])
#define ORB_TEST(rel, sign)                                                                        \
  OP(If##rel) {                                                                                    \
    TEST_IF(SIMPLE(rel));                                                                          \
  }                                                                                                \
  OP(Unless##rel) {                                                                                \
    TEST_UNLESS(SIMPLE(rel));                                                                      \
  }                                                                                                \
  OP(Goto##rel) { TEST_GOTO(SIMPLE(rel)); }                                                        \
  OP(Select##rel) { SELECT(pc->d, holds<Relation::rel>(r[pc->b], r[pc->c])); }                     \
  OP(AddGoto##rel) {                                                                               \
    r[pc->a] = bytecode::add(r[pc->b], r[pc->c]);                                                  \
    if (--budget < 0) {                                                                            \
      ++pc;                                                                                        \
      goto out_of_budget;                                                                          \
    }                                                                                              \
    if (holds<Relation::rel>(r[pc->d], r[pc->e()]))                                                \
      pc = pc->target();                                                                           \
    else                                                                                           \
      pc += 2;                                                                                     \
    NEXT_LINE();                                                                                   \
  }

#define CALCULATED(op)                                                                             \
  std::int32_t value;                                                                              \
  CALCULATE(op, r[pc->a], r[pc->b], pc->b, value)
#define ORB_CALC_TEST(op, s, rel, sign)                                                            \
  OP(If##op##rel) {                                                                                \
    CALCULATED(op);                                                                                \
    TEST_IF(holds<Relation::rel>(value, r[pc->c]));                                                \
  }                                                                                                \
  OP(Unless##op##rel) {                                                                            \
    CALCULATED(op);                                                                                \
    TEST_UNLESS(holds<Relation::rel>(value, r[pc->c]));                                            \
  }                                                                                                \
  OP(Goto##op##rel) {                                                                              \
    CALCULATED(op);                                                                                \
    TEST_GOTO(holds<Relation::rel>(value, r[pc->c]));                                              \
  }                                                                                                \
  OP(Select##op##rel) {                                                                            \
    std::int32_t value;                                                                            \
    CALCULATE(op, r[pc->b], r[pc->c], pc->c, value);                                               \
    SELECT(pc->e(), holds<Relation::rel>(value, r[pc->d]));                                        \
  }

#define TWO(glue, rel1, rel2)                                                                      \
  glued<Glue::glue>(holds<Relation::rel1>(r[pc->a], r[pc->b]),                                     \
                    holds<Relation::rel2>(r[pc->c], r[pc->d]))
#define ORB_TWO_TESTS(glue, rel1, s1, rel2, s2)                                                    \
  OP(If##rel1##glue##rel2) {                                                                       \
    TEST_IF(TWO(glue, rel1, rel2));                                                                \
  }                                                                                                \
  OP(Unless##rel1##glue##rel2) {                                                                   \
    TEST_UNLESS(TWO(glue, rel1, rel2));                                                            \
  }

#include "bytecode/op.def"

  OP(Copy) {
    r[pc->a] = r[pc->b];
    ++pc;
    DISPATCH();
  }
  OP(CopyLine) {
    r[pc->a] = r[pc->b];
    ++pc;
    NEXT_LINE();
  }
  OP(LoadElement) {
    ELEMENT(index, r[index_variable]);
    r[pc->a] = r[index];
    ++pc;
    DISPATCH();
  }
  OP(LoadElementLine) {
    ELEMENT(index, r[index_variable]);
    r[pc->a] = r[index];
    ++pc;
    NEXT_LINE();
  }
  OP(StoreElement) {
    ELEMENT(index, r[index_variable]);
    r[index] = r[pc->a];
    ++pc;
    DISPATCH();
  }
  OP(StoreElementLine) {
    ELEMENT(index, r[index_variable]);
    r[index] = r[pc->a];
    ++pc;
    NEXT_LINE();
  }
  OP(IndexLoad) {
    const std::int32_t y = bytecode::add(r[pc->b], r[pc->c]);
    const std::uint16_t to = pc->a;
    r[index_variable] = y;
    ++pc;
    if (--budget < 0)
      goto out_of_budget;
    ELEMENT(index, y);
    r[to] = r[index];
    ++pc;
    NEXT_LINE();
  }
  OP(IndexStore) {
    const std::int32_t y = bytecode::add(r[pc->b], r[pc->c]);
    const std::uint16_t from = pc->a;
    r[index_variable] = y;
    ++pc;
    if (--budget < 0)
      goto out_of_budget;
    ELEMENT(index, y);
    r[index] = r[from];
    ++pc;
    NEXT_LINE();
  }
  OP(ReadSystem) {
    SLOW(core.read_system(*pc), DISPATCH);
  }
  OP(WriteSystem) {
    SLOW(core.write_system(*pc), DISPATCH);
  }
  OP(Sqrt) {
    SLOW(core.square_root(*pc), DISPATCH);
  }
  OP(Rnd) {
    SLOW(core.random_number(*pc), DISPATCH);
  }
  OP(Abs) {
    r[pc->a] = bytecode::absolute(r[pc->b]);
    ++pc;
    DISPATCH();
  }

  // --- control ----------------------------------------------------------------------------------
  OP(Goto) {
    pc = pc->target();
    NEXT_LINE();
  }
  OP(Gosub) {
    if (core.call_depth == core.calls.size())
      FAULT(BasicError::GosubDepthExceeded);
    core.calls[core.call_depth++] = pc->following_line();
    pc = pc->target();
    NEXT_LINE();
  }
  OP(Return) {
    if (core.call_depth == 0)
      FAULT(BasicError::ReturnWithoutGosub);
    pc = core.calls[--core.call_depth];
    NEXT_LINE();
  }
  OP(OnGoto) {
    const std::uint32_t chosen = static_cast<std::uint32_t>(r[pc->a]) - 1u;
    if (chosen >= pc->b)
      FAULT(BasicError::IllegalIndex);
    const Code* const row = pc + 1 + chosen;
    if (row->a != 0)
      FAULT(static_cast<BasicError>(row->a));
    pc = row;
    pc = pc->target();
    NEXT_LINE();
  }
  OP(OnGosub) {
    const std::uint32_t chosen = static_cast<std::uint32_t>(r[pc->a]) - 1u;
    if (chosen >= pc->b)
      FAULT(BasicError::IllegalIndex);
    const Code* const row = pc + 1 + chosen;
    if (row->a != 0)
      FAULT(static_cast<BasicError>(row->a));
    if (core.call_depth == core.calls.size())
      FAULT(BasicError::GosubDepthExceeded);
    core.calls[core.call_depth++] = pc->following_line();
    pc = row;
    pc = pc->target();
    NEXT_LINE();
  }
  OP(For) {
    r[pc->a] = r[pc->b];
    const std::int32_t end = r[pc->c];
    const std::int32_t step = r[pc->d];
    if (step == 0)
      FAULT(BasicError::BadStepValue);
    if (loop->variable != pc->a) { // the innermost loop may begin again
      if (loop == &core.loops.back())
        FAULT(BasicError::ForDepthExceeded);
      ++loop;
    }
    *loop = {pc->following_line(), end, step, pc->a};
    pc = pc->following_line();
    NEXT_LINE();
  }
  OP(ForElement) {
    const std::int32_t step = r[pc->c];
    if (step == 0)
      FAULT(BasicError::BadStepValue);
    if (loop->variable != element_by_index) {
      if (loop == &core.loops.back())
        FAULT(BasicError::ForDepthExceeded);
      ++loop;
    }
    *loop = {pc->following_line(), r[pc->b], step, element_by_index};
    pc = pc->following_line();
    NEXT_LINE();
  }
  OP(Next) {
    const std::size_t counter = pc->a;
    NEXT_OF(counter);
  }
  OP(NextElement) {
    if (loop->variable != element_by_index)
      FAULT(BasicError::NextWithoutFor);
    ELEMENT(index, r[index_variable]);
    const std::int32_t value = bytecode::add(r[index], loop->step);
    r[index] = value;
    if (loop->step > 0 ? value <= loop->end : value >= loop->end) {
      pc = loop->body;
      NEXT_LINE();
    }
    --loop;
    ++pc;
    NEXT_LINE();
  }
  OP(Skip) {
    pc = pc->target();
    DISPATCH();
  }
  OP(EndLine) {
    ++pc;
    NEXT_LINE();
  }
  OP(End) {
    SYNC();
    return Exit::Ended;
  }
  OP(EndOfProgram) {
    ++budget; // no line of its own
    SYNC();
    return Exit::Ended;
  }
  OP(Target) // never executed
  OP(Trap) {
    FAULT(static_cast<BasicError>(pc->a));
  }

  // --- statements
  // ---------------------------------------------------------------------------------
  OP(PrintText) {
    core.text += core.texts[pc->a];
    ++pc;
    DISPATCH();
  }
  OP(PrintNumber) {
    core.print_number(r[pc->a]);
    ++pc;
    DISPATCH();
  }
  OP(PrintCharacter) {
    core.text += static_cast<char>(static_cast<std::uint8_t>(r[pc->a]));
    ++pc;
    DISPATCH();
  }
  OP(PrintBlank) {
    core.text += ' ';
    ++pc;
    DISPATCH();
  }
  OP(PrintLine) {
    SLOW(core.print(false), NEXT_LINE);
  }
  OP(PrintOpen) {
    SLOW(core.print(true), NEXT_LINE);
  }
  OP(Delay) {
    SLOW(core.delay(r[pc->a]), NEXT_LINE);
  }
  OP(Input) {
    SLOW(core.input(*pc), NEXT_LINE);
  }
  OP(InputTimed) {
    SLOW(core.input_timed(*pc), NEXT_LINE);
  }
  OP(SetData) {
    SLOW(core.set_data(*pc), NEXT_LINE);
  }
  OP(RestartData) {
    core.data_next = 0;
    ++pc;
    NEXT_LINE();
  }
  OP(ReadData) {
    SLOW(core.read_data(*pc), DISPATCH);
  }
  OP(Perform) {
    SLOW(core.perform(*pc), NEXT_LINE);
  }
  OP(Random) {
    core.reseed();
    ++pc;
    NEXT_LINE();
  }
  OP(Tron) {
    SYNC();
    core.tron = true;
    return Exit::Leave;
  }
  OP(Troff) {
    core.tron = false;
    ++pc;
    NEXT_LINE();
  }
  OP(Reset) {
    SLOW(core.reset(), NEXT_LINE);
  }

#ifdef ORB_SWITCH
}
#endif

fault : SYNC();
return Exit::Fault;

out_of_budget : SYNC();
core.pc = pc;
core.budget = 0;
return Exit::Budget;

#undef NEXT_LINE
#undef AND_NEXT
#undef NEXT_OF
#undef SELECT
#undef FAULT
#undef SYNC
#undef SLOW
#undef CALCULATE
#undef ELEMENT
