"""What `check_certificate.py` checks certificates with, one concept a file. "HLW" is Hairer, Lubich & Wanner, Geometric numerical
integration."""
