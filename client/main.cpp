#include "client/cli.h"

int main(int argc, char** argv) { return fjord::RunCommandLine(argc, argv); }
