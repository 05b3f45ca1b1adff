// Signals that tell a program to end in good order: from a user, a terminal that goes away, a batch system, a limit.
#pragma once

#include <csignal>
#include <iterator>

namespace undex {

struct EndSignal {
  int number;
  const char* name;
};

inline constexpr EndSignal end_signals[] = {{SIGINT, "SIGINT"},   {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"},
                                            {SIGQUIT, "SIGQUIT"}, {SIGUSR1, "SIGUSR1"}, {SIGUSR2, "SIGUSR2"},
                                            {SIGALRM, "SIGALRM"}, {SIGXCPU, "SIGXCPU"}};

inline const char* name_of_signal(int number) {
  for (const EndSignal& signal : end_signals)
    if (signal.number == number) return signal.name;
  return "a signal";
}

/// Has `handler` called for each of them. A second SIGINT, SIGTERM or SIGQUIT kills where `second_kills`: somebody insists; batch
/// systems, limits and dying terminals repeat the others by themselves. A SIGHUP that nohup has had ignored stays so.
inline void catch_end_signals(void (*handler)(int), bool second_kills) {
  for (const EndSignal& signal : end_signals) {
    struct sigaction action {};
    if (signal.number == SIGHUP && sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    const bool insists = signal.number == SIGINT || signal.number == SIGTERM || signal.number == SIGQUIT;
    action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART | (second_kills && insists ? static_cast<int>(SA_RESETHAND) : 0);
    sigaction(signal.number, &action, nullptr);
  }
}

}  // namespace undex
