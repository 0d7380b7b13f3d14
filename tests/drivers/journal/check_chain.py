import hashlib
import sqlite3
import sys

chain = "0" * 64
for number, row in enumerate(sqlite3.connect(sys.argv[1]).execute("SELECT * FROM journal ORDER BY n"), 1):
    cells = ["-," if cell is None else f"{len(str(cell).encode())}:{cell}," for cell in row[:-1]]
    chain = hashlib.sha256((chain + "".join(cells)).encode()).hexdigest()
    if row[0] != number or row[-1] != chain:
        sys.exit(f"row {number}: changed, missing or moved")
