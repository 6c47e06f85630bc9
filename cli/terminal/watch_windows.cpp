#include "cli/terminal/watch.h"

#include "cli/terminal/interrupt.h"
#include "disk/disk.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <tuple>
#include <windows.h>

#include <shellapi.h> // needs what that declares

namespace orb::cli {
namespace {

constexpr DWORD period_ms = 100; ///< how often the files are looked at

/// Is set for a process that is one run of a command that is watched.
constexpr const wchar_t* mark = L"ORB_WATCHED_RUN";

/// What changes when a file is written, replaced or removed: whether it is there, which one, how
/// long and when written.
using Stamp = std::tuple<bool, DWORD, DWORD, DWORD, DWORD, DWORD>;

Stamp stamp(const std::string& path) {
  const auto file = ::CreateFileW(disk::as_path(path).c_str(), FILE_READ_ATTRIBUTES,
                                  FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                  OPEN_EXISTING, 0, nullptr);
  if (file == INVALID_HANDLE_VALUE)
    return {};
  BY_HANDLE_FILE_INFORMATION info{};
  ::GetFileInformationByHandle(file, &info);
  ::CloseHandle(file);
  return {true,
          info.nFileIndexHigh,
          info.nFileIndexLow,
          info.nFileSizeLow,
          info.ftLastWriteTime.dwHighDateTime,
          info.ftLastWriteTime.dwLowDateTime};
}

std::vector<Stamp> stamps(const std::vector<std::string>& files) {
  std::vector<Stamp> list;
  for (const auto& file : files)
    list.push_back(stamp(file));
  return list;
}

/// A word of a command line, as CommandLineToArgvW() reads it back: a backslash counts as one of
/// two only before a quote.
std::wstring quoted(const std::wstring& word) {
  std::wstring out = L"\"";
  std::size_t slashes = 0;
  for (const auto c : word) {
    if (c == L'"')
      out.append(slashes + 1, L'\\');
    slashes = c == L'\\' ? slashes + 1 : 0;
    out += c;
  }
  return out.append(slashes, L'\\') + L'"';
}

/// The command line of this process with `words` among its options, which end at `--`.
std::wstring command_line(const std::vector<std::string>& words) {
  int count = 0;
  wchar_t** const given = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::wstring> all(given, given + count);
  ::LocalFree(given);
  auto place = std::find(all.begin(), all.end(), L"--");
  for (const auto& word : words)
    place = std::next(all.insert(place, disk::as_path(word).wstring()));
  std::wstring line;
  for (const auto& word : all)
    line += (line.empty() ? L"" : L" ") + quoted(word);
  return line;
}

/// A job, in which a process ends with this one, however that comes about.
HANDLE make_job() {
  const auto job = ::CreateJobObjectW(nullptr, nullptr);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

/// One run of the command in a process of its own.
class Run {
public:
  Run(Context& context, HANDLE job, std::wstring line) {
    std::array<wchar_t, 32768> program{}; // as long as a path may be
    ::GetModuleFileNameW(nullptr, program.data(), program.size());
    STARTUPINFOW start{};
    start.cb = sizeof start;
    start.dwFlags = STARTF_USESTDHANDLES;
    start.hStdInput = ::GetStdHandle(STD_INPUT_HANDLE);
    start.hStdOutput = ::GetStdHandle(STD_OUTPUT_HANDLE);
    start.hStdError = ::GetStdHandle(STD_ERROR_HANDLE);
    PROCESS_INFORMATION made{};
    ::SetEnvironmentVariableW(mark, L"1");
    const bool begun = ::CreateProcessW(program.data(), line.data(), nullptr, nullptr, TRUE,
                                        CREATE_SUSPENDED, nullptr, nullptr, &start, &made) != 0;
    const auto error = static_cast<int>(::GetLastError());
    ::SetEnvironmentVariableW(mark, nullptr);
    if (!begun) {
      print_error(context, fmt::format("cannot start a run: {}; the next change tries again",
                                       std::system_category().message(error)));
      return;
    }
    ::AssignProcessToJobObject(job, made.hProcess);
    ::ResumeThread(made.hThread);
    ::CloseHandle(made.hThread);
    process_ = made.hProcess;
  }
  ~Run() {
    if (process_ == nullptr)
      return;
    ::TerminateProcess(process_, EXIT_FAILURE);
    ::WaitForSingleObject(process_, INFINITE);
    ::CloseHandle(process_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Takes note of an end since the last call: the code that it left.
  std::optional<DWORD> ended() {
    if (process_ == nullptr || ::WaitForSingleObject(process_, 0) != WAIT_OBJECT_0)
      return std::nullopt;
    DWORD code = 0;
    ::GetExitCodeProcess(process_, &code);
    ::CloseHandle(process_);
    process_ = nullptr;
    return code;
  }

private:
  HANDLE process_ = nullptr;
};

} // namespace

void watch(Context& context, const std::function<std::vector<std::string>()>& list,
           const std::function<void()>& once, const std::function<void()>& ended,
           const std::vector<std::string>& words) {
  if (::GetEnvironmentVariableW(mark, nullptr, 0) != 0)
    return once();
  context.exit = ExitCode::Done;
  const InterruptGuard guard;
  const auto job = make_job();
  const auto line = command_line(words);
  auto files = list();
  auto seen = stamps(files);
  std::optional<Run> run;
  run.emplace(context, job, line);
  for (; InterruptGuard::asked() == 0; ::Sleep(period_ms)) {
    if (const auto code = run->ended()) {
      if (*code == ERROR_BROKEN_PIPE)
        return; // nobody reads any more
      ended();
      print_note(context, "waiting for a change; Ctrl-C ends");
    }
    const auto now = stamps(files);
    if (now == seen)
      continue;
    const auto changed = std::mismatch(now.begin(), now.end(), seen.begin()).first - now.begin();
    print_note(context, fmt::format("--- {} changed", files[static_cast<std::size_t>(changed)]));
    files = list();
    seen = stamps(files);
    run.reset();
    run.emplace(context, job, line);
  }
}

} // namespace orb::cli
