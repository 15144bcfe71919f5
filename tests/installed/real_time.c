/* The C interface of the installed library: a folder without a run is an error with a sentence. */
#include <stdio.h>

#include "myoid.h"

int main(void) {
  char error[200] = "";
  if (myoid_open("no_such_folder", NULL, error, sizeof error) != NULL || error[0] == '\0') return 1;
  printf("%s: %s\n", myoid_version(), error);
  return 0;
}
