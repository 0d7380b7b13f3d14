"""What an emulated disk was asked to write, in its order: the log of the emulator's driver blklogwrites.

    begin                   a sector: magic, version, entries, bytes of a sector
    each request            a sector: the sector written to, how many, flags, bytes of the data; then the data

Each write that the board had acknowledged before it asked for a flush is on the disk afterwards; of those
since, a disk may have kept any part when its power went.
"""
import mmap
import os
import struct

MAGIC = 0x6A736677736872
SECTOR = 512
FLUSH, FUA, DISCARD, MARK = 1, 2, 4, 8
PIECE = 4096  # what a file system holds for one; a larger request may be done in part


def arguments(image, log):
    """The emulator's, for /dev/vda that is `image` and logged to `log`."""
    return ("-blockdev", f"driver=file,node-name=image,filename={image},detect-zeroes=off",
            "-blockdev", f"driver=file,node-name=log,filename={log}",
            "-blockdev", "driver=blklogwrites,node-name=logged,file=image,log=log,"
                         f"log-sector-size={SECTOR},log-super-update-interval=1",
            "-device", "virtio-blk-pci,drive=logged")


class Entry:
    """One request: what it writes stands in the log at `at`."""

    def __init__(self, sector, sectors, flags, at):
        self.place, self.bytes, self.flags, self.at = sector * SECTOR, sectors * SECTOR, flags, at

    @property
    def writes(self):
        return self.bytes > 0 and not self.flags & (DISCARD | MARK)


class WriteLog:
    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        magic, version, count, sector = struct.unpack_from("<QQQI", self.data)
        if (magic, version, sector) != (MAGIC, 1, SECTOR):
            raise ValueError(f"{path}: no log of writes: {magic:x}, version {version}, sectors of {sector}")
        self.entries = []
        at = SECTOR
        for _ in range(count):
            place, sectors, flags, _ = struct.unpack_from("<QQQQ", self.data, at)
            at += SECTOR
            self.entries.append(Entry(place, sectors, flags, at))
            at += 0 if flags & DISCARD else sectors * SECTOR

    def last_flush(self, count):
        """How many of the first `count` requests are on the disk for certain."""
        while count > 0 and not self.entries[count - 1].flags & FLUSH:
            count -= 1
        return count

    def apply(self, image, entry, keep=None):
        """Writes one request to the file descriptor `image`: the whole, or the pieces that `keep()` says."""
        if not entry.writes:
            return
        for begin in range(0, entry.bytes, entry.bytes if keep is None else PIECE):
            size = entry.bytes if keep is None else min(PIECE, entry.bytes - begin)
            if keep is None or entry.flags & FUA or keep():
                at = entry.at + begin
                os.pwrite(image, self.data[at:at + size], entry.place + begin)
