autocmd BufRead,BufNewFile *.bas,*.orbbas setlocal filetype=orbbasic
autocmd BufRead,BufNewFile *.orb setlocal filetype=orbstructured
autocmd BufRead,BufNewFile *.macro setlocal filetype=orbmacro
autocmd BufRead,BufNewFile *.test setlocal filetype=orbtest
autocmd BufRead,BufNewFile *.stimulus setlocal filetype=orbstimulus
