"""C's inner loops over the cells of a mapped mesh; `fem.native` loads what build.py has made of them."""
