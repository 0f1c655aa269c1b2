// seeker-lab: offline experiments. All code is in libraries.

#include "server/lab/command/commands.hpp"

int main(int argc, char** argv) { return seeker::lab::run_lab(argc, argv); }
