// Runs a program that knows nothing of toys, compiled with its main renamed, after the registries'
// two lines.
#include "tests/toy/toys.h"

int ProgramMain(int argc, char** argv);

int main(int argc, char** argv) {
  fjord::FractalRegistry().Extend(fjord::testing::ToyMethod());
  fjord::StageRegistry().Extend(fjord::testing::ToyStage());
  return ProgramMain(argc, argv);
}
