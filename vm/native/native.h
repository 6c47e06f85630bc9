#pragma once

#include "bytecode/chunk.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::vm {

struct Core;

/// When a program becomes machine code: once it has run for long, before it starts, or never.
enum class Native : std::uint8_t { Auto, On, Off };

/// Whether this build has a back end for the processor that it was built for.
bool has_native_code();

/// A program as machine code. It knows arithmetic, Z, tests, loops, jumps and subroutines; it
/// leaves every other line, and every rare case such as an error, to the loop of machine/loop.h. It
/// may stop before every line and begin with every line.
class NativeCode {
public:
  /// What a line became, for profilers; line 0 is the way in, or out.
  struct Piece {
    int line = 0;
    const void* address = nullptr;
    std::size_t size = 0;
  };

  /// The chunk passes bytecode::verify(). Where it can only be interpreted, the reason in words:
  /// no back end, memory that must not become executable, a program that no ball can hold.
  static tl::expected<std::unique_ptr<NativeCode>, std::string_view>
  compile(const bytecode::Chunk& chunk);
  NativeCode(const NativeCode&) = delete;
  NativeCode& operator=(const NativeCode&) = delete;
  ~NativeCode();

  /// Executes lines from core.pc on, until a line is not for it, or the budget may not be enough
  /// for the lines that are counted together; core.pc is then the line that is next. Everything
  /// else in `core` is as the loop would have left it.
  void run(Core& core) const;

  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Lines that are counted together. Where the budget is smaller, the loop does the rest.
  static constexpr int longest_block = 16;

private:
  NativeCode() = default;

  void* memory_ = nullptr;
  std::size_t size_ = 0;
  const void* const* table_ = nullptr; ///< by first instruction of a line: where it begins
  std::vector<Piece> pieces_;
};

/// Machine code of several programs, so that balls which run the same one share it. Balls may ask
/// from several threads; what they get lives as long as this object.
class NativePrograms {
public:
  /// Null where there is none, or where so many programs are kept that one more would not fit.
  const NativeCode* find(const bytecode::Chunk& chunk);

private:
  struct Kept {
    bytecode::Chunk chunk;
    std::unique_ptr<NativeCode> code;
  };
  std::mutex mutex_;
  std::vector<Kept> kept_;
};

/// Machine code as text.
struct NativeListing {
  std::string entry;              ///< the way into it
  std::vector<std::string> lines; ///< in the order of the chunk's
  std::string exits;              ///< the way out, of each line and of all
};

/// Empty where this build has no back end.
NativeListing native_listing(const bytecode::Chunk& chunk);

} // namespace orb::vm
