// Put before the C library of a program it makes fsync() and fdatasync() say that all is well, and
// do nothing: a product that forgot them, which the test of power cuts must find out.

extern "C" {

int fsync(int descriptor);
int fdatasync(int descriptor);

int fsync(int /*descriptor*/) { return 0; }
int fdatasync(int /*descriptor*/) { return 0; }
}
