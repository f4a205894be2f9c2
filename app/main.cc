// plumbline: Galerkin reference solutions for nonlocal models, and verification of meshfree rules.

#include "command.h"

int main(int argc, char **argv)
{
  return plumbline::app::command(argc, argv);
}
