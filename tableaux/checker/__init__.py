"""What `check_certificate.py` does not prove itself, one kind of claim a file. Each file imports from it and from the files before.

rootings, splittings, solutions, stability, tables. HLW is Hairer, Lubich & Wanner, Geometric numerical integration.
"""
