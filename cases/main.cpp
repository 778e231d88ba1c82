#include <iostream>

#include "cases/cli.hpp"

int main(int argc, char** argv) { return gambeson::runCommand(argc, argv, std::cout, std::cerr); }
