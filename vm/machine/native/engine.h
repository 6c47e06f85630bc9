#pragma once

#include "vm/machine/core.h"
#include "vm/machine/native/native.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace orb::vm {

/// Decides when the program of a machine is compiled, and when machine code runs instead of the
/// loop.
class NativeEngine {
public:
  /// `shared`, if given, supplies machine code and must outlive this object.
  NativeEngine(Native when, NativePrograms* shared) : when_(when), shared_(shared) {}
  /// Copies the state for a copy of the machine. Shared machine code is kept; otherwise the copy
  /// compiles its own.
  NativeEngine(const NativeEngine& other);
  NativeEngine& operator=(const NativeEngine&) = delete;

  /// Starts another program of this many instructions.
  void begin(std::size_t instructions);

  /// Returns how many of `lines` may run, after `done` lines of the program, before the next call.
  /// Compiles the program when it is time.
  std::int64_t until_asked(std::int64_t lines, std::uint64_t done, const bytecode::Chunk& chunk);

  /// Runs what the budget of `core` allows, in machine code if that pays, otherwise in the loop.
  Exit run(Core& core, const Engine& loop);

  /// The machine code of the program; null if it is interpreted.
  const NativeCode* code() const { return code_; }
  /// Why the program has no machine code although it was requested; empty otherwise.
  std::string_view only_interpreted() const { return only_interpreted_; }

private:
  void compile(const bytecode::Chunk& chunk);
  Exit run_code(Core& core, const Engine& loop);

  Native when_;
  NativePrograms* shared_;
  std::unique_ptr<NativeCode> own_;
  const NativeCode* code_ = nullptr;
  std::string_view only_interpreted_;
  std::uint64_t threshold_ = 0;  ///< lines before the program is compiled
  std::uint64_t compile_at_ = 0; ///< as threshold_, but never once it has been tried
  std::int64_t gain_ = 0;        ///< in lines; below 0 if switching to machine code did not pay
};

} // namespace orb::vm
