// The loop that runs orbBasic: one block per instruction of bytecode/op.def. threaded.cpp and
// switch.cpp each include it once, inside a function with a Core& core. They define
//   OP(name)       begins the block of an instruction
//   OP_LINE(name)  begins the block of an instruction that ends its line
//   DISPATCH()     jumps to the block of `pc`
//
// NEXT_LINE ends a line at the cost of one decrement and one compare. Everything else that may
// happen (other parts of the ball, the end of `--for`, tracing) is folded into that budget.
//
// Optimisations tried without gain (speed of the kernels of `./dev bench` relative to without):
// `-O3` 0.97; `(b + c) & d` in one instruction 1.00; no counting of lines after operations 1.00;
// instructions of 32 bytes instead of 24 1.00; the following line as an index 0.99; the number of
// open calls in a register 1.04 for subroutines, 0.93 for the sort; a jump instead of a conditional
// move 0.87 for branches; no alignment of blocks, blocks in text order, `-fno-tree-pre` 0.98 to
// 1.00; an unsigned index into Z 1.00.

using bytecode::element_by_index;
using bytecode::element_count;
using bytecode::first_element;
using bytecode::index_variable;
using spec::BasicError;

const Code* pc = core.pc;
Loop* loop = core.frames.loop;
std::int64_t budget = core.budget;
const Code* const code = core.code.data();
std::int32_t* const r = core.registers.data();
const std::int64_t* const reciprocal = core.reciprocals.data();

#define NEXT_LINE()                                                                                \
  do {                                                                                             \
    if (--budget < 0)                                                                              \
      goto out_of_budget;                                                                          \
    DISPATCH();                                                                                    \
  } while (false)

// Ends the line and continues with the next one in the text.
#define FOLLOWING_LINE()                                                                           \
  do {                                                                                             \
    pc = pc->following_line();                                                                     \
    NEXT_LINE();                                                                                   \
  } while (false)

#define FAULT(what)                                                                                \
  do {                                                                                             \
    core.error = what;                                                                             \
    goto fault;                                                                                    \
  } while (false)

// Stores the loop's registers for a slow operation; `next` is where the loop resumes.
#define SYNC(next)                                                                                 \
  core.at = pc;                                                                                    \
  core.pc = next;                                                                                  \
  core.frames.loop = loop;                                                                         \
  core.budget = budget

#define SLOW(next, call)                                                                           \
  SYNC(next);                                                                                      \
  if (const Then flow = call; flow != Then::Next)                                                  \
  return flow == Then::Fault ? Exit::Fault : Exit::Leave

// The element of Z selected by Y.
#define ELEMENT(index)                                                                             \
  if (static_cast<std::uint32_t>(r[index_variable]) - 1u >= element_count)                         \
    FAULT(BasicError::IllegalIndex);                                                               \
  const auto index = first_element + static_cast<std::size_t>(r[index_variable]) - 1

#define A r[pc->a]
#define B r[pc->b]
#define C r[pc->c]
#define D r[pc->d]

// An operation that never ends its line.
#define STEP(name, ...)                                                                            \
  OP(name) {                                                                                       \
    __VA_ARGS__;                                                                                   \
    ++pc;                                                                                          \
    DISPATCH();                                                                                    \
  }

// An operation that may end its line.
#define VALUE(name, ...)                                                                           \
  STEP(name, __VA_ARGS__)                                                                          \
  OP_LINE(name) {                                                                                  \
    __VA_ARGS__;                                                                                   \
    ++pc;                                                                                          \
    NEXT_LINE();                                                                                   \
  }

// A statement that always ends its line; most run outside the loop.
#define STATEMENT(name, ...)                                                                       \
  OP(name) {                                                                                       \
    __VA_ARGS__;                                                                                   \
    FOLLOWING_LINE();                                                                              \
  }

NEXT_LINE();

#ifdef ORB_SWITCH
dispatch : switch (reinterpret_cast<std::uintptr_t>(pc->handler)) {
#endif

  // --- values -----------------------------------------------------------------------------------
  VALUE(Copy, A = B)
  VALUE(Add, A = bytecode::add(B, C))
  VALUE(Subtract, A = bytecode::subtract(B, C))
  VALUE(Multiply, A = bytecode::multiply(B, C))
  VALUE(Divide, if (C == 0) FAULT(BasicError::DivideByZero); A = bytecode::divide(B, C))
  VALUE(Remainder, if (C == 0) FAULT(BasicError::DivideByZero); A = bytecode::remainder(B, C))
  VALUE(MultiplyAdd, A = bytecode::add(bytecode::multiply(B, C), D))
  VALUE(DivideBy, A = bytecode::divide_by(B, reciprocal[pc->c]))
  VALUE(RemainderBy, A = bytecode::remainder_by(B, C, reciprocal[pc->c]))
  VALUE(DivideSubtract, A = bytecode::subtract(D, bytecode::divide_by(B, reciprocal[pc->c])))
  VALUE(RemainderAdd, A = bytecode::add(bytecode::remainder_by(B, C, reciprocal[pc->c]), D))
  VALUE(DivideByPower, A = bytecode::before_cut(B, C) >> pc->d)
  VALUE(RemainderByPower, A = bytecode::subtract(B, bytecode::before_cut(B, C) & -C))
  VALUE(ShiftLeft, if (!bytecode::is_shift_count(C)) FAULT(BasicError::BadNumericParameter);
        A = bytecode::shift_left(B, C))
  VALUE(ShiftRight, if (!bytecode::is_shift_count(C)) FAULT(BasicError::BadNumericParameter);
        A = bytecode::shift_right(B, C))
  VALUE(And, A = B & C)
  VALUE(Or, A = B | C)
  VALUE(Abs, A = bytecode::absolute(B))
  VALUE(Sqrt, SLOW(pc + 1, core.square_root(*pc)))
  VALUE(Rnd, SLOW(pc + 1, core.random_number(*pc)))
  VALUE(LoadElement, ELEMENT(index); A = r[index])
  VALUE(StoreElement, ELEMENT(index); r[index] = A)
  VALUE(ReadSystem, SLOW(pc + 1, core.read_system(*pc)))
  OP(WriteSystem) {
    SLOW((pc + 1)->target(), core.write_system(*pc)); // `goto` ends the line
    ++pc;
    DISPATCH();
  }
  OP_LINE(WriteSystem) {
    SLOW(pc + 1, core.write_system(*pc));
    ++pc;
    NEXT_LINE();
  }
  VALUE(ReadData, SLOW(pc + 1, core.read_data(*pc)))

  // --- decisions --------------------------------------------------------------------------------
#define TEST(name, condition, jumping, passing)                                                    \
  name {                                                                                           \
    if (condition) {                                                                               \
      pc = pc->target();                                                                           \
      jumping();                                                                                   \
    }                                                                                              \
    ++pc;                                                                                          \
    passing();                                                                                     \
  }

#define SELECT(name, condition)                                                                    \
  OP(Select##name) {                                                                               \
    const std::int32_t where_true = D;                                                             \
    const std::int32_t where_false = r[pc->d + 1u];                                                \
    A = condition ? where_true : where_false;                                                      \
    ++pc;                                                                                          \
    NEXT_LINE();                                                                                   \
  }

#define RELATION(name, sign)                                                                       \
  TEST(OP(Unless##name), !(A sign B), DISPATCH, DISPATCH)                                          \
  TEST(OP_LINE(Unless##name), !(A sign B), NEXT_LINE, DISPATCH)                                    \
  TEST(OP(When##name), A sign B, DISPATCH, DISPATCH)                                               \
  TEST(OP_LINE(When##name), A sign B, NEXT_LINE, NEXT_LINE)                                        \
  SELECT(name, B sign C)
  RELATION(Equal, ==)
  RELATION(NotEqual, !=)
  RELATION(Less, <)
  RELATION(Greater, >)
  SELECT(Clear, (B & C) == 0)

  // --- control ----------------------------------------------------------------------------------
  TEST(OP(Goto), true, DISPATCH, DISPATCH)
  TEST(OP_LINE(Goto), true, NEXT_LINE, NEXT_LINE)

#define CALL(first)                                                                                \
  if (core.frames.call_depth == core.frames.calls.size())                                          \
    FAULT(BasicError::GosubDepthExceeded);                                                         \
  core.frames.calls[core.frames.call_depth++] = core.index_of(pc->following_line());               \
  pc = first;                                                                                      \
  NEXT_LINE()

  OP(Gosub) {
    CALL(pc->target());
  }
  OP(Return) {
    if (core.frames.call_depth == 0)
      FAULT(BasicError::ReturnWithoutGosub);
    pc = code + core.frames.calls[--core.frames.call_depth];
    NEXT_LINE();
  }

// The list entry selected by A.
#define CHOSEN(row)                                                                                \
  if (static_cast<std::uint32_t>(A) - 1u >= pc->b)                                                 \
    FAULT(BasicError::IllegalIndex);                                                               \
  const Code* const row = pc + A;                                                                  \
  if (row->a != 0)                                                                                 \
  FAULT(static_cast<BasicError>(row->a))

  OP(OnGoto) {
    CHOSEN(row);
    pc = row->target();
    NEXT_LINE();
  }
  OP(OnGosub) {
    CHOSEN(row);
    CALL(row->target());
  }

// Pushes a loop, or restarts the innermost one if it has the same variable.
#define BEGIN_LOOP(counter, last, by)                                                              \
  if (by == 0)                                                                                     \
    FAULT(BasicError::BadStepValue);                                                               \
  if (loop->variable != (counter)) {                                                               \
    if (loop == &core.frames.loops.back())                                                         \
      FAULT(BasicError::ForDepthExceeded);                                                         \
    ++loop;                                                                                        \
  }                                                                                                \
  *loop = {core.index_of(pc->following_line()), last, by, counter};                                \
  FOLLOWING_LINE()

#define STEP_LOOP(counter)                                                                         \
  const std::int32_t step = loop->step;                                                            \
  const std::int32_t value = bytecode::add(counter, step);                                         \
  counter = value;                                                                                 \
  const std::int32_t down = step >> 31; /* inverts both where the loop counts down */              \
  if ((value ^ down) <= (loop->end ^ down)) {                                                      \
    pc = code + loop->body;                                                                        \
    NEXT_LINE();                                                                                   \
  }                                                                                                \
  --loop;                                                                                          \
  FOLLOWING_LINE()

  OP(For) {
    A = B;
    BEGIN_LOOP(pc->a, C, D);
  }
  OP(ForElement) {
    BEGIN_LOOP(element_by_index, B, C);
  }
  OP(Next) {
    if (loop->variable != pc->a)
      FAULT(BasicError::NextWithoutFor);
    STEP_LOOP(A);
  }
  OP(NextElement) {
    if (loop->variable != element_by_index)
      FAULT(BasicError::NextWithoutFor);
    ELEMENT(index);
    STEP_LOOP(r[index]);
  }
  OP(End) {
    SYNC(pc);
    return Exit::Ended;
  }
  OP(EndOfProgram) {
    ++budget; // the end of the text is not a line
    SYNC(pc);
    return Exit::Ended;
  }
  OP(Target) // never executed
  OP(Trap) {
    FAULT(static_cast<BasicError>(pc->a));
  }

  // --- statements -------------------------------------------------------------------------------
  STEP(PrintText, core.text += core.chunk.texts[pc->a])
  STEP(PrintNumber, core.print_number(A))
  STEP(PrintCharacter, core.text += static_cast<char>(static_cast<std::uint8_t>(A)))
  STEP(PrintBlank, core.text += ' ')
  STATEMENT(PrintLine, SLOW(pc->following_line(), core.print(PrintEnd::Line)))
  STATEMENT(PrintOpen, SLOW(pc->following_line(), core.print(PrintEnd::Open)))
  STATEMENT(Delay, SLOW(pc->following_line(), core.delay(A)))
  STATEMENT(Input, SLOW(pc->following_line(), core.input(*pc)))
  STATEMENT(InputTimed, SLOW(pc->following_line(), core.input_timed(*pc)))
  STATEMENT(SetData, SLOW(pc->following_line(), core.set_data(*pc)))
  STATEMENT(RestartData, core.data_next = 0)
  STATEMENT(Perform, SLOW(pc->following_line(), core.perform(*pc)))
  STATEMENT(Random, core.reseed())
  STATEMENT(Tron, SLOW(pc->following_line(), core.trace()))
  STATEMENT(Troff, core.tron = false)
  STATEMENT(Reset, SLOW(pc->following_line(), core.reset()))

#ifdef ORB_SWITCH
}
#endif

fault : SYNC(pc);
return Exit::Fault;

out_of_budget : SYNC(pc);
core.budget = 0;
return Exit::Budget;
