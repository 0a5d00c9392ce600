// What people read: errors and notes on stderr, results on stdout. One mutex keeps lines whole when
// several threads speak, and clears a progress bar before anything else is printed. Whatever it
// holds, nothing of a line commands a terminal (printable.h).
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace fjord::console {

bool StderrIsTerminal();
int TerminalWidth();  // columns of stderr; 80 where unknown

// A line on stderr.
void Note(const std::string& line);
// The error on stderr, and the exit code that goes with it.
int Fail(const Error& error);
int Fail(const Errors& errors);

// The live lines at the bottom of a terminal, taking the place of those before; none clears them.
// Nothing on a pipe. They may hold colours: whoever makes them cleans the names in them.
void SetLive(const std::vector<std::string>& lines);

// stdout, flushed; kIo where it is closed or full.
Result<> Print(const std::string& text);

}  // namespace fjord::console
