#pragma once

#include "vm/machine/core.h"
#include "vm/native/native.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace orb::vm {

/// Decides when the program of a machine becomes machine code, and when that runs in place of the
/// loop.
class NativeEngine {
public:
  /// Machine code is taken from `shared`, where that is given; it must outlive this object.
  NativeEngine(Native when, NativePrograms* shared) : when_(when), shared_(shared) {}
  /// For a copy of the machine. Machine code comes along where it is shared; else the copy makes
  /// its own.
  NativeEngine(const NativeEngine& other);
  NativeEngine& operator=(const NativeEngine&) = delete;

  /// Another program, of so many instructions, begins.
  void begin(std::size_t instructions);

  /// How many of `lines` may run, after `done` lines of this program, before it is asked again.
  std::int64_t until_asked(std::int64_t lines, std::uint64_t done, const bytecode::Chunk& chunk);

  /// Runs what the budget of `core` allows: as machine code where that pays, else by the loop.
  Exit run(Core& core, const Engine& loop);

  /// The machine code of the program; null where it is interpreted.
  const NativeCode* code() const { return code_; }
  /// Why there is none although it was wanted; empty otherwise.
  std::string_view only_interpreted() const { return only_interpreted_; }

private:
  void compile(const bytecode::Chunk& chunk);
  Exit run_code(Core& core, const Engine& loop);

  Native when_;
  NativePrograms* shared_;
  std::unique_ptr<NativeCode> own_;
  const NativeCode* code_ = nullptr;
  std::string_view only_interpreted_;
  std::uint64_t threshold_ = 0;  ///< lines of a program before it is compiled
  std::uint64_t compile_at_ = 0; ///< the same; never, once it has been tried
  std::int64_t gain_ = 0;        ///< lines; below 0 where changes to machine code did not pay
};

} // namespace orb::vm
