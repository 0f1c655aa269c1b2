// seeker-lab: offline experiments. Everything is in libraries.

#include "server/lab/command/commands.hpp"

int main(int argc, char** argv) { return seeker::lab::run_lab(argc, argv); }
